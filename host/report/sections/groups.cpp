#include "host/report/sections/groups.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <map>
#include <tuple>

#include "host/base/text/sense.hpp"
#include "host/report/page/html.hpp"

namespace astro::report {

namespace {

using recording::RunInfo;

struct Key {
  int kind_rank;
  std::string kind;
  int direction_rank;
  long size_mm;
  bool operator<(const Key& o) const {
    return std::tie(kind_rank, kind, direction_rank, size_mm) <
           std::tie(o.kind_rank, o.kind, o.direction_rank, o.size_mm);
  }
};

Key key_of(const RunInfo& info) {
  constexpr std::array known{"square", "circle", "line"};
  const auto found = std::find(known.begin(), known.end(), info.kind);
  const int direction = info.direction == Sense::cw ? 0 : info.direction == Sense::ccw ? 1 : 2;
  return {static_cast<int>(found - known.begin()), info.kind, direction,
          static_cast<long>(info.size_m * 1000 + 0.5)};
}

std::string title_of(const RunInfo& info) {
  std::string title;
  if (info.kind == "square")
    title = fmt::format("Squares of {:g} m", info.size_m);
  else if (info.kind == "circle")
    title = fmt::format("Circles of {:g} m radius", info.size_m);
  else if (info.kind == "line")
    title = fmt::format("Straight lines of {:g} m", info.size_m);
  else
    title = info.kind.empty() ? "Other runs" : capitalised(info.kind);
  const std::string direction = direction_name(info.direction);
  return direction.empty() ? title : title + ", " + direction;
}

}  // namespace

std::size_t RunGroup::most_runs() const {
  std::size_t most = 0;
  for (const auto& runs : phases) most = std::max(most, runs.size());
  return most;
}

std::string direction_name(std::optional<Sense> direction) { return direction ? in_words(*direction) : ""; }

std::vector<RunGroup> group_runs(const std::vector<Phase>& phases) {
  std::map<Key, RunGroup> groups;
  for (std::size_t phase = 0; phase < phases.size(); ++phase) {
    for (const auto& run : phases[phase].runs) {
      if (run.odometry.empty()) continue;
      auto& group = groups[key_of(run.info)];
      group.title = title_of(run.info);
      group.kind = run.info.kind;
      group.phases.resize(phases.size());
      group.phases[phase].push_back(&run);
    }
  }
  std::vector<RunGroup> out;
  for (auto& [key, group] : groups) {
    for (auto& runs : group.phases) {
      std::stable_sort(runs.begin(), runs.end(),
                       [](auto* a, auto* b) { return a->info.index < b->info.index; });
    }
    out.push_back(std::move(group));
  }
  return out;
}

}  // namespace astro::report
