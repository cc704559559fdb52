#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "host/base/error.hpp"
#include "host/import/bags/stamp_count.hpp"

/// Reads poses in bags, whatever published them: ground truth of a tracker, or a robot's own odometry.
namespace astro::importing {

/// Poses that belong together: those of one topic between one pair of frames. `child_frame` is "" if the
/// messages have none.
struct PoseStream {
  std::string topic, type;         // "/tf", "tf2_msgs/msg/TFMessage"
  std::string frame, child_frame;  // "map", "base_link"
  std::uint64_t poses = 0;
  StampCount stamps;
  std::int64_t first_ns = 0, last_ns = 0;  // of the recorder

  std::string name() const;  // "/tf map base_link"
};

struct TimedPose {
  std::int64_t time_ns = 0;
  double x_m = 0, y_m = 0, z_m = 0;
  double qx = 0, qy = 0, qz = 0, qw = 1;  // as in the message: perhaps not of length 1, perhaps NaN

  bool operator==(const TimedPose&) const = default;
};

struct PoseTopic {
  PoseStream stream;
  std::vector<TimedPose> poses;  // times increase strictly
  std::vector<Remark> remarks;   // what was inferred or left out
};

/// A field that is "" allows any value.
struct PoseSelection {
  std::string topic, frame, child_frame;
};

/// All streams of poses in the order of the bag, at most 10,000. Errors as read_bag (host/formats/files).
std::vector<PoseStream> pose_streams(const std::filesystem::path& path);

/// Whether a robot or a filter publishes such poses of itself. The type shows it for odometry, transforms and
/// poses with a covariance, the topic's name for others. A topic whose name contains a word for ground truth
/// or for a tracking system counts as no estimate.
bool is_estimate(const PoseStream& stream);

/// The only stream that is selected. If several are, the only one whose topic is named like ground truth, or
/// else the only one that is not an estimate. An estimate is chosen only if the selection names it, because
/// wheels that are calibrated against their own odometry seem perfect. A remark says what was inferred, and
/// whether the chosen stream is an estimate.
///
/// Errors  UnclearChoice with the names of the streams if none or several remain; `path` is for its message.
const PoseStream& chosen_stream(const std::filesystem::path& path, std::span<const PoseStream> streams,
                                const PoseSelection& selection, std::vector<Remark>& remarks);

/// The one that chosen_stream finds if nothing is selected; null if none or several remain.
const PoseStream* recognised_stream(std::span<const PoseStream> streams);

/// The poses of the stream that chosen_stream selects. Times are header.stamp, and poses without a stamp are
/// left out; but if most poses have no stamp, the recorder's times are used for all. A remark says if the
/// stamps are far from the recorder's times or drift against them.
///
/// Errors  UnclearChoice (unclear_choice.hpp) with the names of the streams if none or several remain;
///         astro::Error naming the file if it is not a bag, or has more poses than a file of its size can
///         hold.
PoseTopic poses_in_bag(const std::filesystem::path& path, const PoseSelection& selection = {});

}  // namespace astro::importing
