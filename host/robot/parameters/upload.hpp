#pragma once

#include <map>
#include <string>
#include <vector>

#include "host/base/error.hpp"
#include "host/robot/parameters/parameters.hpp"

namespace astro::robot {

/// The set that the robot holds after an upload; never a mixture.
enum class ActiveSet { old_set, new_set };

struct UploadedValue {
  std::string name, unit;
  Value before, wanted, now;  // wanted: rounded to what the robot can hold
};

struct UploadReport {
  ActiveSet active = ActiveSet::old_set;
  bool link_dropped = false;  // during the upload; the robot was found again and asked
  std::vector<UploadedValue> values;

  /// What happened, and what the robot holds now. Its kind is `active`; it has the value "link_dropped" if
  /// the link dropped.
  Remark remark() const;
};

/// Puts new values in force as one set: checks all of them, opens the robot's staging area, stages, commits,
/// reads the whole table back and compares. If the link drops, it reconnects within `reconnect_timeout` and
/// asks which set the robot holds; if the new set is not in force then, it is not sent again.
///
/// Throws Error for a value that the table does not allow or a name that it does not have, before anything is
/// changed; RobotRefused if the robot refuses the set and keeps the old one (staging_lost: another session
/// has begun to change parameters meanwhile, and may continue); LinkLost if the robot does not come back (it
/// holds the whole old set or the whole new one); Error if it holds neither.
UploadReport upload(Client& client, const std::map<std::string, Value>& values,
                    microseconds reconnect_timeout = std::chrono::seconds(10));

}  // namespace astro::robot
