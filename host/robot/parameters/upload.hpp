#pragma once

#include <functional>
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

/// The same for callers that must not wait for a lost link, and that have other work between two requests: refuses a robot
/// that drives before anything is sent (RobotRefused, moving), opens the staging area, stages, commits and reads the values
/// back. `between` is called before each request and may throw; `patience` is that of the first request.
///
/// Throws Error as RemoteParameters::stage and commit do.
void commit_at_rest(
    Client& client, RemoteParameters& parameters, const std::map<std::string, Value>& values,
    const std::function<void()>& between = [] {}, RetryPolicy patience = {});

/// Throws Error that names the first of `values` that the robot does not hold, as it was read last.
void require_read_back(const RemoteParameters& parameters, const std::map<std::string, Value>& values);

}  // namespace astro::robot
