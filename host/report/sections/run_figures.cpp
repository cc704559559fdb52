#include "host/report/sections/run_figures.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "host/report/page/html.hpp"

namespace astro::report {

namespace {

/// The number of a run: its index in the recording if there is one, otherwise its position.
std::string run_number(const RunGroup& group, std::size_t position) {
  for (const auto& runs : group.phases) {
    if (position < runs.size() && runs[position]->info.index > 0)
      return std::to_string(runs[position]->info.index);
  }
  return std::to_string(position + 1);
}

std::string selector(const RunGroup& group, std::size_t number) {
  if (group.most_runs() < 2) return "";
  std::string out = R"(<fieldset class="selector" data-runs><legend>Run</legend>)";
  for (std::size_t i = 0; i < group.most_runs(); ++i) {
    out += fmt::format(
        R"(<label><input type="radio" name="runs-{}" value="{}" autocomplete="off"{}><span>{}</span></label>)",
        number, i, i == 0 ? " checked" : "", run_number(group, i));
  }
  return out +
         fmt::format(
             R"(<label><input type="radio" name="runs-{}" value="all" autocomplete="off"><span>all</span></label></fieldset>)",
             number);
}

std::string path_figure(const ReportInput& input, const RunGroup& group, std::size_t number,
                        std::size_t phase) {
  const std::string title = capitalised(input.phases[phase].title);
  return fmt::format(
      R"(<figure data-figure="path" data-group="{}" data-phase="{}"><figcaption class="phase-{}">{}, <span class="chosen">run {}</span></figcaption>
<div class="plot" role="img" aria-label="{}, {}: true path and path by odometry"></div></figure>)",
      number, phase, phase % kAccents, escape(title), run_number(group, 0), escape(group.title),
      escape(title));
}

std::string error_figure(const RunGroup& group, std::size_t number) {
  const auto tracked = [](const auto& runs) {
    return std::any_of(runs.begin(), runs.end(), [](auto* run) { return !run->truth.empty(); });
  };
  if (std::none_of(group.phases.begin(), group.phases.end(), tracked)) {
    return R"(<p class="quiet">No ground truth was recorded along these runs, so there are no errors over time.</p>)";
  }
  return fmt::format(
      R"(<figure data-figure="errors" data-group="{}"><figcaption>Errors along the way (ground truth minus odometry), <span class="chosen">run {}</span></figcaption>
<div class="plot" role="img" aria-label="{}: x, y and heading error over time, every phase"></div></figure>)",
      number, run_number(group, 0), escape(group.title));
}

std::string group_section(const ReportInput& input, const RunGroup& group, std::size_t number) {
  std::string paths;
  for (std::size_t phase = 0; phase < group.phases.size(); ++phase) {
    if (!group.phases[phase].empty()) paths += path_figure(input, group, number, phase);
  }
  const char* const stretched =
      group.kind == "line"
          ? R"(<p class="quiet">Sideways motion is drawn in millimetres, far larger than the way ahead.</p>)"
          : "";
  return fmt::format(
      R"(<section class="group" data-group="{}"><h3>{}</h3>{}{}<div class="panels">{}</div>{}</section>)",
      number, escape(group.title), selector(group, number), stretched, paths, error_figure(group, number));
}

}  // namespace

Section run_figures(const ReportInput& input, const std::vector<RunGroup>& groups) {
  Section out{"runs", "Runs: odometry against ground truth", ""};
  for (std::size_t i = 0; i < groups.size(); ++i) out.body += group_section(input, groups[i], i);
  return out;
}

}  // namespace astro::report
