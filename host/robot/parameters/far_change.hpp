#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "host/robot/parameters/parameters.hpp"

/// Decides which new values a person has to confirm, no matter whether a command line, a ROS 2 node or a viewer requests
/// them.
namespace astro::robot {

/// One parameter that a new set would change.
struct Change {
  std::string name, unit;
  Value before, after;
};

/// What `values` would change on the robot, in the order of its table; values that it holds already are left
/// out. Throws astro::Error for a name that the robot does not have or a value that its table does not allow.
std::vector<Change> changes(const RemoteParameters& robot, const std::map<std::string, Value>& values);

/// Finds values so far from those on the robot that they are probably a typing error or a wrong unit. Returns a clause for
/// each, with both values and the unit. A change is far
///   - for c_R, c_L and b: by a factor of at least 1.1, up or down,
///   - for e: by more than 0.1; the sentences below do not apply to e,
///   - for kappa0: by a factor of at least 10,
///   - for a nominal size: by a factor of at least 1.25,
///   - for a limit or a supply voltage: by a factor of at least 2,
///   - for any other number: by a factor of at least 3.
/// A change of sign is always far, and so is a change to 0, because 0 switches some of them off: without a command_timeout a
/// robot drives on if its host disappears. If the present value is 0, the new one is compared with the default.
std::vector<std::string> far_changes(const RemoteParameters& robot, const std::vector<Change>& changes);

/// c_R, c_L, b, e and kappa0, which a calibration finds.
bool is_wheel_factor(std::string_view name);
/// Whether a change of e is far. It is judged by difference and not by ratio, because e is 0 for many robots and may have
/// either sign.
bool is_far_e(const Change& change);

}  // namespace astro::robot
