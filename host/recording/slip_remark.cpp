#include "host/recording/slip_remark.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "host/base/text/degrees.hpp"
#include "host/recording/recording_problem.hpp"

namespace astro::recording {

std::optional<Remark> slip_remark(const Run& run, const std::string& name) {
  if (run.slips.empty() || run.odometry.empty()) return std::nullopt;
  constexpr std::size_t kMostTold = 5;
  const std::size_t told = std::min(run.slips.size(), kMostTold), others = run.slips.size() - told;
  std::vector<std::string> values{name};
  std::string turns;
  for (const GyroSlip& slip : std::span(run.slips).first(told)) {
    const double after_s = 1e-6 * static_cast<double>(slip.time_us - run.odometry.front().time_us);
    values.push_back(fmt::format("{:.1f}", degrees(slip.turn_rad)));
    values.push_back(fmt::format("{:.1f}", after_s));
    turns += fmt::format("{}{} degrees at {} s", turns.empty() ? "" : ", ", values[values.size() - 2],
                         values.back());
  }
  if (others > 0) turns += fmt::format(", and {} more", others);
  return Remark{name + ": by its gyro the robot turned without its wheels: " + turns,
                RecordingProblem::turned_unseen, std::move(values)};
}

}  // namespace astro::recording
