#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "host/formats/messages/stamped_pose.hpp"
#include "host/truth/source/pose3.hpp"

namespace astro::truth {

/// Two transforms of a chain move. Values: its last and its first frame, and those whose transforms move.
enum class FrameProblem { two_move };

/// Transforms `inner` by `outer`, which is the pose of the frame that `inner` is given in. A rotation need not be exactly of
/// length 1; one of length 0 makes the result NaN, which no body can have.
Pose3 composed(const Pose3& outer, const Pose3& inner);

/// A frame's name without the leading slash that older programs write.
std::string plain_frame(std::string_view name);

/// Coordinate frames and the transforms between them, as /tf and /tf_static publish them: each frame has at most one
/// parent, and the last transform of it is kept.
///
/// Only one transform of a chain may move, because a tracker measures one; so its time is the chain's, and nothing has to be
/// interpolated. Bounds: some thousand frames; a chain has no more than some dozens.
class FrameTree {
 public:
  /// `fixed`: it holds for ever, as those of /tf_static do.
  void put(const ros2::StampedPose& transform, bool fixed);

  /// The frames from `child` up to `parent`, both included; if they are not connected, as far up as is known. If `parent` is
  /// "", up to the child's own parent.
  std::vector<std::string> chain(const std::string& child, const std::string& parent) const;

  /// The frame of a chain whose transform to the frame above brings new poses. It is the one that has moved; if none has yet,
  /// it is the topmost that is not fixed. Nothing if all are fixed. Throws astro::Error if two have moved. Precondition, also
  /// of pose(): chain() has returned `chain`.
  std::optional<std::string> moving(const std::vector<std::string>& chain) const;
  /// The pose of a chain's first frame in its last one.
  Pose3 pose(const std::vector<std::string>& chain) const;

 private:
  struct Transform {
    std::string parent;
    Pose3 pose;
    bool fixed = false;
    bool moved = false;  // it had another pose before
  };

  std::map<std::string, Transform> transforms_;  // by child
};

}  // namespace astro::truth
