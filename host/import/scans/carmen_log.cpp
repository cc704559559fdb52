#include "host/import/scans/carmen_log.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "host/base/error.hpp"
#include "host/base/order_statistics.hpp"
#include "host/formats/files/bag.hpp"
#include "host/formats/tables/text_file.hpp"
#include "host/import/scans/carmen_messages.hpp"

namespace astro::importing {
namespace {

constexpr double kNearest_m = 0.15, kFarthest_m = 20;
/// The samples have no times; they follow each other in steps of a millisecond.
constexpr std::int64_t kStep_ns = 1'000'000;

/// Where a log says that the robot is. mapped: by the mapping program, which repeats its result as odometry; this tells it also if
/// the scan itself is lost.
struct LogPose {
  Pose2 pose;
  bool scan = false, mapped = false;
};

Pose2 step_between(const Pose2& from, const Pose2& to) { return wrapped(from.between(to)); }

bool same_pose(const Pose2& a, const Pose2& b) {
  return a.x_m == b.x_m && a.y_m == b.y_m && a.theta_rad == b.theta_rad;
}

/// A step's motion along the arc and sideways of it.
struct ArcStep {
  double along_m, sideways_m, turned_rad;
};

ArcStep arc_step(const Pose2& step) {
  const Point2 chord = Point2{step.x_m, step.y_m}.turned(-step.theta_rad / 2);
  return {chord.x_m / sinc(step.theta_rad / 2), chord.y_m, step.theta_rad};
}

/// How far a step brings the robot, with turns as the way of a wheel.
double motion_m(const ArcStep& step) {
  constexpr double kHalfTrack_m = 0.2;
  return std::abs(step.along_m) + kHalfTrack_m * std::abs(step.turned_rad);
}

/// What the steps onto scans ("leaps") and those of odometry are like.
struct Leaps {
  std::vector<double> leaps_m, steps_m;  // sideways
  std::size_t onward = 0, back = 0, leaps = 0, repeated = 0;
  double leapt_m = 0, stepped_m = 0;  // motion, added up
  bool mapped = false;

  explicit Leaps(const std::vector<LogPose>& poses) {
    ArcStep before{};
    for (std::size_t i = 1; i < poses.size(); ++i) {
      const ArcStep step = arc_step(step_between(poses[i - 1].pose, poses[i].pose));
      const bool repeats = i + 1 < poses.size() && same_pose(poses[i].pose, poses[i + 1].pose);
      mapped = mapped || poses[i].mapped;
      poses[i].scan ? add_leap(step, before, repeats)
                    : add_step(step, poses[i - 1].scan && same_pose(poses[i - 1].pose, poses[i].pose));
      before = step;
    }
  }

 private:
  void add_leap(const ArcStep& step, const ArcStep& before, bool repeats) {
    constexpr double kMoves_m = 1e-3;
    leaps_m.push_back(std::abs(step.sideways_m));
    leapt_m += motion_m(step);
    if (step.along_m != 0 || step.turned_rad != 0) {
      ++leaps;
      if (repeats) ++repeated;
    }
    if (std::abs(step.along_m) > kMoves_m && std::abs(before.along_m) > kMoves_m)
      ++(step.along_m * before.along_m < 0 ? back : onward);
  }
  /// A line that repeats the scan's pose is no step, and says nothing of how steps scatter.
  void add_step(const ArcStep& step, bool repeats_scan) {
    if (repeats_scan) return;
    steps_m.push_back(std::abs(step.sideways_m));
    stepped_m += motion_m(step);
  }
};

/// Whether the scans' poses leap away from where odometry ended: odometry is repeated from there, or they leap sideways or against
/// the motion before, as no wheels move. A raw log may repeat the poses of its scans, too, but there the leaps are the motion.
bool poses_leap(const std::vector<LogPose>& poses) {
  constexpr double kRounding_m = 5e-4, kClearly = 3, kOften = 0.2, kNearlyAll = 0.9, kCorrections = 0.5;
  Leaps all(poses);
  const auto part_of = [](std::size_t some, std::size_t of) {
    return static_cast<double>(some) / static_cast<double>(std::max<std::size_t>(of, 1));
  };
  const bool mostly_repeated = part_of(all.repeated, all.leaps) > kNearlyAll;
  if (mostly_repeated && all.mapped) return true;
  if (all.leaps == 0 || all.steps_m.empty()) return false;
  return (mostly_repeated && all.leapt_m < kCorrections * all.stepped_m) ||
         part_of(all.back, all.back + all.onward) > kOften ||
         median_of(std::move(all.leaps_m)) > kRounding_m + kClearly * median_of(std::move(all.steps_m));
}

/// Finds the range that stands for "nothing seen": many beams have exactly this value, to the millimetre of such logs, and only
/// glitches lie beyond it.
class GreatestRange {
 public:
  void add(const std::vector<float>& ranges_m) {
    for (const float range_m : ranges_m) {
      const double in_mm = std::round(1e3 * static_cast<double>(range_m));
      ++counts_[static_cast<std::size_t>(std::clamp(in_mm, 0.0, static_cast<double>(counts_.size() - 1)))];
    }
    all_ += ranges_m.size();
  }
  double limit_m() const {
    constexpr std::size_t kMany = 100, kGlitches = 500;  // one in so many
    std::size_t beyond = 0;
    for (std::size_t mm = counts_.size(); mm-- > 0 && beyond * kGlitches <= all_; beyond += counts_[mm])
      if (counts_[mm] * kMany > all_) return std::min(kFarthest_m, below(1e-3 * static_cast<double>(mm)));
    return kFarthest_m;
  }
  /// Excludes readings of exactly this range.
  static double below(double range_m) { return 0.999 * range_m; }

 private:
  /// The last one is of all ranges that lie so far that they do not count anyway.
  std::vector<std::size_t> counts_ = std::vector<std::size_t>(static_cast<std::size_t>(1.1e3 * kFarthest_m));
  std::size_t all_ = 0;
};

struct Walk {
  calibration::WheelSample sample;
  double way_m = 0, turned_rad = 0;

  void add(const ArcStep& step, double wheelbase_m) {
    sample.left_m += step.along_m - step.turned_rad * wheelbase_m / 2;
    sample.right_m += step.along_m + step.turned_rad * wheelbase_m / 2;
    way_m += std::abs(step.along_m);
    turned_rad += std::abs(step.turned_rad);
  }
};

double seconds_of(std::size_t index) {
  return 1e-9 * static_cast<double>(static_cast<std::int64_t>(index) * kStep_ns);
}

/// Odometry as wheels. Whether a leap onto a scan counts depends on the log.
void add_wheels(const std::vector<LogPose>& poses, double wheelbase_m, CarmenLog& log) {
  Walk walk;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const bool leap = log.corrected && (poses[i].scan || poses[i].mapped);
    if (i > 0 && !leap) walk.add(arc_step(step_between(poses[i - 1].pose, poses[i].pose)), wheelbase_m);
    walk.sample.time_s = seconds_of(i);
    log.drive.wheels.push_back(walk.sample);
  }
  log.way_m = walk.way_m;
  log.turned_rad = walk.turned_rad;
}

void require_both(const CarmenLog& log, const std::string& file) {
  if (log.scans == 0)
    throw Error("'" + file + "' has no scans: no line begins with FLASER or ROBOTLASER1",
                ScanFileProblem::no_scans, {file});
  if (log.odometry < 2)
    throw Error("'" + file +
                    "' has scans but no odometry: no line begins with ODOM, and the poses of the "
                    "scans may be those of a map",
                ScanFileProblem::no_odometry, {file});
}

}  // namespace

bool is_carmen_log(const std::filesystem::path& path) {
  if (bag::is_bag(path)) return false;
  const Bytes text = tables::text_of_file(path);
  return is_carmen_log(as_text(text));
}

CarmenLog read_carmen_log(const std::filesystem::path& path, double wheelbase_m) {
  const auto bytes = std::make_shared<const Bytes>(tables::text_of_file(path));
  const std::string_view laser = carmen_laser(as_text(*bytes));
  CarmenLog log;
  log.drive.name = path.filename().string();
  log.drive.times_measured = false;
  std::vector<LogPose> poses;
  GreatestRange greatest;
  log.damaged = each_carmen_message(as_text(*bytes), laser, [&](const CarmenMessage& message) {
    if (message.is_end_of_mapping) {
      if (!poses.empty() && !poses.back().scan) poses.back().mapped = true;
      return;
    }
    ++(message.is_scan ? log.scans : log.odometry);
    poses.push_back({message.robot, message.is_scan, false});
    if (message.is_scan) greatest.add(message.scan.ranges_m);
  });
  require_both(log, path.string());
  log.corrected = poses_leap(poses);
  add_wheels(poses, wheelbase_m, log);
  log.drive.read_scans = [bytes, laser, limit_m = greatest.limit_m()](const lidar::ScanHandler& handle) {
    std::int64_t index = 0;
    each_carmen_message(as_text(*bytes), laser, [&](CarmenMessage& message) {
      if (message.is_end_of_mapping) return;
      const std::int64_t time_ns = kStep_ns * index++;
      if (!message.is_scan) return;
      message.scan.time_ns = time_ns;
      message.scan.range_min_m = kNearest_m;
      const double said_m = message.scan.range_max_m;
      message.scan.range_max_m = said_m > 0 ? std::min(limit_m, GreatestRange::below(said_m)) : limit_m;
      handle(message.scan);
    });
  };
  return log;
}

}  // namespace astro::importing
