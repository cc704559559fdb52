#pragma once

#include <cstdint>
#include <optional>

#include "host/base/bytes.hpp"
#include "host/robot/sharing/port_user.hpp"

namespace astro::robot {

/// Whose the robot's staged parameters are: those of the program that last sent RevertParameters or
/// DefaultParameters. As long as no program has, the robot itself decides.
class StagingArea {
 public:
  /// Checked when a request is sent to the robot, not when it arrived, because others may have opened the area
  /// meanwhile. Returns false if it stages, commits or applies what is not this program's.
  bool allows(SessionId id, std::uint8_t message);
  /// What is staged is another program's, or was.
  bool hides_from(SessionId id) const { return opened_ && owner_ != id; }

  /// The program's values are nobody's now.
  void release(SessionId id);
  /// The robot has restarted.
  void clear() { *this = {}; }

 private:
  bool opened_ = false;             // through this relay; until then the robot decides
  std::optional<SessionId> owner_;  // nothing: closed
};

/// A ParameterValue that shows the active value in place of the staged one. Any other body comes back as it is.
Bytes without_staged(ByteView body);

}  // namespace astro::robot
