#include "host/commands/truth/next_command.hpp"

#include <algorithm>
#include <optional>
#include <string_view>
#include <vector>

#include "host/import/scans/bag_scans.hpp"

namespace astro::commands {
namespace {

using importing::BagInspection;
using importing::FileInspection;
using importing::WheelSource;
using importing::WheelUnit;

/// As a shell takes it for one word.
std::string word(const std::string& text) {
  constexpr std::string_view kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./:,%@";
  if (!text.empty() && text.find_first_not_of(kPlain) == text.npos) return text;
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? "'\\''" : std::string(1, c);
  return quoted + "'";
}

std::string option(const char* name, const std::string& value) {
  return value.empty() ? "" : std::string(" ") + name + ' ' + word(value);
}

std::string sizes(std::optional<WheelUnit> unit) {
  return std::string(" --wheel-diameter METRES") +
         (unit.value_or(WheelUnit::counts) == WheelUnit::counts ? " --counts-per-turn COUNTS" : "") +
         " --wheelbase METRES";
}

std::string of_table(const ImportOptions& choices) {
  std::string text = option("--wheel-columns", choices.table.columns);
  if (choices.table.per_interval) text += " --per-interval";
  if (choices.table.counter_range)
    text += " --counter-range " + std::to_string(static_cast<long long>(*choices.table.counter_range));
  return text;
}

/// Bodies without a name cannot be named, and are the only ones of their files.
std::string body_choice(const truth::Inspection& tracker) {
  return tracker.bodies.size() + tracker.bodies_left_out > 1 ? " --body NAME" : "";
}

std::string of_bag_wheels(const BagInspection& bag) {
  if (!bag.source) return " --wheels-topic TOPIC";
  std::string text;
  if (bag.source->kind == WheelSource::Kind::joints) {
    if (!bag.wheels) text += " --joints LEFT,RIGHT";
  } else if (bag.sources.size() > 1) {
    text += option("--wheels-topic", bag.source->name());
  }
  return text +
         (bag.source->kind == WheelSource::Kind::fields && !bag.source->measure ? " --wheels-unit UNIT" : "");
}

/// The unit that the wheels of a bag will have; nothing if that is not known.
std::optional<WheelUnit> unit_of(const BagInspection& bag) {
  if (!bag.source) return std::nullopt;
  if (bag.source->kind == WheelSource::Kind::joints) return WheelUnit::radians;
  if (bag.source->kind == WheelSource::Kind::odometry) return WheelUnit::metres;
  return bag.source->measure ? std::optional(bag.source->measure->unit) : std::nullopt;
}

std::string of_bag(const std::string& file, const BagInspection& bag) {
  if (bag.run) return "runs " + file;
  const bool any_truth = bag.truth || !std::ranges::all_of(bag.poses, importing::is_estimate);
  const std::vector<std::string> scans = importing::scan_topics(bag.report.topics);
  const std::string topic = !any_truth  ? ""
                            : bag.truth ? option("--truth-topic", bag.truth->topic)
                                        : " --truth-topic TOPIC";
  const std::string wheels = of_bag_wheels(bag), robot = sizes(unit_of(bag));
  if (!bag.sources.empty() && any_truth) return "bag " + file + wheels + topic + robot;
  if (!bag.sources.empty() && !scans.empty())
    return "bag " + file + wheels + (scans.size() > 1 ? " --scan-topic TOPIC" : "") + robot;
  if (!bag.sources.empty()) return "files --wheels " + file + wheels + " --truth TRUTH" + robot;
  return any_truth ? "files --wheels WHEELS --truth " + file + topic + robot : "";
}

std::string arguments(const std::string& file, const FileInspection& found, const ImportOptions& choices) {
  if (found.bag) return of_bag(file, *found.bag);
  if (found.robot) return "files --wheels WHEELS --truth TRUTH --robot " + file;
  if (found.end_poses) return "end-poses --cw " + file + " --ccw OTHERS --side METRES --wheelbase METRES";
  const std::string of_truth = found.tracker ? option("--truth-columns", choices.truth_columns) +
                                                   option("--truth-topic", choices.truth_topic) +
                                                   body_choice(*found.tracker)
                                             : "";
  return "files --wheels " + (found.wheels ? file + of_table(choices) : "WHEELS") + " --truth " +
         (found.tracker ? file + of_truth : "TRUTH") +
         sizes(found.wheels ? std::optional(found.wheels->track.unit) : std::nullopt);
}

}  // namespace

std::string next_command(const std::filesystem::path& path, const FileInspection& found,
                         const ImportOptions& choices) {
  const std::string words = arguments(word(path.string()), found, choices);
  return words.empty() ? "" : "astrolabe calibrate " + words;
}

std::string command_for_log(const std::filesystem::path& path) {
  const std::string file = word(path.string());
  return "astrolabe calibrate files --wheels " + file + " --truth scan:" + file + " --wheelbase METRES";
}

}  // namespace astro::commands
