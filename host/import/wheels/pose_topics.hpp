#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "host/base/error.hpp"
#include "host/import/wheels/stamp_count.hpp"

/// Poses in bags, from whatever published them: ground truth of a tracker, or a robot's own odometry.
namespace astro::importing {

/// Poses that belong together: those of a topic between one pair of frames. Messages without a child frame have "".
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

/// What is not given ("") may be anything.
struct PoseSelection {
  std::string topic, frame, child_frame;
};

/// All streams of poses in the order of the bag, at most 10,000. Errors as read_bag (host/formats/files).
std::vector<PoseStream> pose_streams(const std::filesystem::path& path);

/// Whether a robot or a filter publishes such poses of itself: odometry, transforms and poses with a covariance by their
/// type, others by their topic's name. A topic whose name speaks of ground truth or of a tracking system holds none.
bool is_estimate(const PoseStream& stream);

/// The only stream that is selected. If several are, the only one whose topic's name speaks of ground truth, or else the
/// only one that is no estimate. An estimate is chosen only if the selection names it, because wheels that are
/// calibrated against their own odometry seem perfect. A remark says what was inferred, and that an estimate was named.
///
/// Errors  UnclearChoice with the names of the streams if none or several are left; `path` is for its text.
const PoseStream& chosen_stream(const std::filesystem::path& path, std::span<const PoseStream> streams,
                                const PoseSelection& selection, std::vector<Remark>& remarks);

/// The poses of the stream that is selected or can be told to be ground truth (chosen_stream). Times are header.stamp, and
/// poses without one are left out, or those of the recorder if most have none. A remark says if stamps are far from the
/// recorder's times or drift against them.
///
/// Errors  UnclearChoice (unclear_choice.hpp) with the names of the streams if none or several are left; astro::Error
///         naming the file if it is no bag, or packs more poses than are taken from one of its size.
PoseTopic poses_in_bag(const std::filesystem::path& path, const PoseSelection& selection = {});

}  // namespace astro::importing
