#pragma once

#include <cstdint>
#include <optional>

#include "host/base/bytes.hpp"
#include "host/robot/sharing/port_user.hpp"

namespace astro::robot {

/// Knows which program owns the robot's staged parameters: the one that last sent RevertParameters or
/// DefaultParameters. As long as no program has sent one of them, the robot itself decides.
class StagingArea {
 public:
  /// Returns false if the request stages, commits or applies values, and the area is not this program's. To
  /// be called when the request is sent to the robot, not when it arrived, because others may have opened the
  /// area meanwhile.
  bool allows(SessionId id, std::uint8_t message);
  /// The staged values belong to another program, or belonged to one that has gone.
  bool hides_from(SessionId id) const { return opened_ && owner_ != id; }

  /// The program gives up its staged values; they belong to nobody then.
  void release(SessionId id);
  /// The robot has restarted.
  void clear() { *this = {}; }

 private:
  bool opened_ = false;             // through this relay; until then the robot decides
  std::optional<SessionId> owner_;  // nothing: nobody owns the staged values
};

/// A ParameterValue that shows the active value in place of the staged one. Any other body comes back as it is.
Bytes without_staged(ByteView body);

}  // namespace astro::robot
