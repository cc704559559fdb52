#include "host/import/scans/carmen_log.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "host/base/error.hpp"
#include "host/base/order_statistics.hpp"
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

/// Whether the scans' poses leap away from where odometry ended: odometry is repeated from there, or they leap sideways or against
/// the motion before, as no wheels move.
bool poses_leap(const std::vector<LogPose>& poses) {
  constexpr double kRounding_m = 5e-4, kClearly = 3, kOften = 0.2, kMoves_m = 1e-3, kNearlyAll = 0.9;
  std::vector<double> leaps_m, steps_m;
  std::size_t onward = 0, back = 0, leaps = 0, repeated = 0;
  ArcStep before{};
  for (std::size_t i = 1; i < poses.size(); ++i) {
    const ArcStep step = arc_step(step_between(poses[i - 1].pose, poses[i].pose));
    (poses[i].scan ? leaps_m : steps_m).push_back(std::abs(step.sideways_m));
    if (poses[i].scan && (step.along_m != 0 || step.turned_rad != 0)) {
      ++leaps;
      if (i + 1 < poses.size() && same_pose(poses[i].pose, poses[i + 1].pose)) ++repeated;
    }
    if (poses[i].scan && std::abs(step.along_m) > kMoves_m && std::abs(before.along_m) > kMoves_m)
      ++(step.along_m * before.along_m < 0 ? back : onward);
    before = step;
  }
  if (leaps_m.empty() || steps_m.empty() || leaps == 0) return false;
  const auto part_of = [](std::size_t some, std::size_t all) {
    return static_cast<double>(some) / static_cast<double>(std::max<std::size_t>(all, 1));
  };
  return part_of(repeated, leaps) > kNearlyAll || part_of(back, back + onward) > kOften ||
         median_of(std::move(leaps_m)) > kRounding_m + kClearly * median_of(std::move(steps_m));
}

/// The greatest range if it stands for "nothing seen": many beams have exactly this value.
class GreatestRange {
 public:
  void add(const std::vector<float>& ranges_m) {
    for (const float range_m : ranges_m) {
      ++all_;
      if (range_m > greatest_m_) {
        greatest_m_ = range_m;
        count_ = 0;
      }
      if (range_m == greatest_m_) ++count_;
    }
  }
  double limit_m() const {
    constexpr std::size_t kOneOf = 100;
    const bool means_nothing = count_ * kOneOf > all_;
    return means_nothing ? std::min(kFarthest_m, 0.999 * static_cast<double>(greatest_m_)) : kFarthest_m;
  }

 private:
  float greatest_m_ = 0;
  std::size_t count_ = 0, all_ = 0;
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
      message.scan.range_max_m = limit_m;
      handle(message.scan);
    });
  };
  return log;
}

}  // namespace astro::importing
