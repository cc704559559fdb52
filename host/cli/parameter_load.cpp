#include "host/cli/parameter_load.hpp"

#include <fmt/format.h>

#include "host/base/error.hpp"
#include "host/cli/console.hpp"
#include "host/cli/params_view.hpp"
#include "host/experiment/robot_identity.hpp"

namespace astro::cli {
namespace {

void warn_of_another_robot(const link::Client& client, const experiment::ParameterFile& file) {
  const std::string other = experiment::different_robots("the calibration", file.robot, "this",
                                                         experiment::identity_of(client.robot()));
  if (!other.empty()) say("warning: " + other);
}

/// Values that were only tried are in force, but not in the robot's flash yet.
void keep_what_was_tried(link::RemoteParameters robot, const experiment::ParameterFile& file) {
  for (const auto& [name, value] : file.parameters) robot.stage(name, value);
  robot.commit();
  say("the robot holds these values already");
}

}  // namespace

bool warn_of_far_changes(const link::RemoteParameters& robot,
                         const std::vector<experiment::Change>& changes) {
  const std::vector<std::string> far = experiment::far_changes(robot, changes);
  for (const std::string& clause : far) say("warning: " + clause);
  for (const experiment::Change& change : changes)
    if (change.name == "command_timeout" && change.after == link::Value(0.0))
      say("warning: with command_timeout = 0 a robot goes on driving when its host has gone");
  return !far.empty();
}

bool agreed(const link::RemoteParameters& robot, const std::vector<experiment::Change>& changes, bool yes,
            std::size_t unasked) {
  say(table(experiment::side_by_side(changes), "llrrr"));
  const bool far = warn_of_far_changes(robot, changes);
  if (yes || (changes.size() <= unasked && !far)) return true;
  return confirm(changes.size() == 1 ? "Put this value in force?"
                                     : fmt::format("Put these {} values in force?", changes.size()));
}

Loaded load_parameters(link::Client& client, const link::RemoteParameters& robot,
                       const experiment::ParameterFile& file, const LoadOptions& options) {
  warn_of_another_robot(client, file);
  Loaded loaded{experiment::changes(robot, file.parameters), std::nullopt};
  if (loaded.changes.empty()) {
    keep_what_was_tried(robot, file);
    return loaded;
  }
  say(table(experiment::side_by_side(loaded.changes), "llrrr"));
  if (const std::string why = experiment::objection(robot, file, loaded.changes);
      !why.empty() && !options.force)
    throw Error(why);
  warn_of_far_changes(robot, loaded.changes);
  if (const std::string note = experiment::insignificance(loaded.changes, file.standard_errors);
      !note.empty())
    say(note);
  if (!options.yes && !confirm("Load these into the robot?")) throw Error("nothing was changed");
  loaded.report = link::upload(client, file.parameters);
  return loaded;
}

}  // namespace astro::cli
