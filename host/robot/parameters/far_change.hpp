#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "host/robot/parameters/parameters.hpp"

/// Which new values a person has to confirm, whoever asks for them: a command line, a node of ROS 2, a viewer.
namespace astro::robot {

/// One parameter that a new set would change.
struct Change {
  std::string name, unit;
  Value before, after;
};

/// What `values` would change on the robot, in the order of its table; values that it holds already are left
/// out. Throws astro::Error for a name that the robot does not have or a value that its table does not allow.
std::vector<Change> changes(const RemoteParameters& robot, const std::map<std::string, Value>& values);

/// Values so far from those on the robot that they are probably a typing error or a wrong unit: a clause for
/// each, with both values and the unit. A wheel factor is far if it moves by more than a
/// tenth, e by more than 0.1 (to 0, to the other sign or not), kappa0 by more than ten times, a nominal size by more than a quarter, a limit or a supply voltage if it is halved or doubled, and
/// any other number if it is three times as much or as little; a changed sign always is, and so is 0 where
/// there was none, which switches some of them off: without a command_timeout a robot drives on if its host disappears. A value
/// that comes in place of 0 is compared with the default.
std::vector<std::string> far_changes(const RemoteParameters& robot, const std::vector<Change>& changes);

/// c_R, c_L, b, e and kappa0, which a calibration finds.
bool is_wheel_factor(std::string_view name);
/// Of e, which is 0 for many robots and may have either sign, so its change is no ratio.
bool is_far_e(const Change& change);

}  // namespace astro::robot
