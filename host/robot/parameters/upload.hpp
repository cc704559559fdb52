#pragma once

#include <map>
#include <string>
#include <vector>

#include "host/robot/parameters/parameters.hpp"

namespace astro::robot {

/// Which set the robot holds after an upload; never a mixture.
enum class ActiveSet { old_set, new_set };

struct UploadedValue {
  std::string name, unit;
  Value before, wanted, now;  // wanted: rounded to what the robot can hold
};

struct UploadReport {
  ActiveSet active = ActiveSet::old_set;
  bool link_dropped = false;  // on the way; the robot was found again and asked
  std::vector<UploadedValue> values;

  /// What happened and what the robot holds now, for people.
  std::string sentence() const;
};

/// Puts new values in force as one set: checks all of them, opens the robot's staging area, stages, commits,
/// reads the whole table back and compares. If the link drops, the robot is looked for again for `patience`
/// each time and asked which set it holds; a set that was not in force by then is dropped, not sent again.
///
/// Throws Error for a value that the table does not allow or a name it does not have, before anything is
/// changed; RobotRefused if the robot does not take the set, which then stays as it was (staging_lost:
/// another session has begun to change parameters meanwhile, and is left to go on); LinkLost if the robot
/// does not come back (it holds the old set or the new one, whole); Error if it holds neither.
UploadReport upload(Client& client, const std::map<std::string, Value>& values,
                    microseconds patience = std::chrono::seconds(10));

}  // namespace astro::robot
