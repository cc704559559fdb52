#include "host/commands/shared/parameter_load.hpp"

#include <fmt/format.h>

#include "host/base/error.hpp"
#include "host/commands/base/advice.hpp"
#include "host/commands/shared/params_view.hpp"
#include "host/console/console.hpp"
#include "host/experiment/analysis/judgement_sentences.hpp"
#include "host/experiment/files/robot_identity.hpp"

namespace astro::commands {
namespace {

constexpr Advice kUploadAdvice[] = {
    {experiment::UploadProblem::of_other_robot, ": calibrate this one (--force uploads all the same)"},
    {experiment::UploadProblem::incomplete, ": calibrate again (--force uploads all the same)"},
    {experiment::UploadProblem::foreign_e, ": calibrate again (--force uploads all the same)"},
    {experiment::UploadProblem::of_other_wheel,
     ": load the old values or drive again (--force uploads all the same)"},
    {experiment::UploadProblem::of_other_factors,
     ": load the old values or drive again (--force uploads all the same)"},
    {experiment::UploadProblem::suspicious, ": check units, side and robot (--force uploads all the same)"},
};

/// Writes values to flash that are in force already, because they may only have been tried.
void save_tried_values(robot::RemoteParameters robot, const experiment::ParameterValues& values) {
  for (const auto& [name, value] : values) robot.stage(name, value);
  robot.commit();
  console::say("the robot holds these values already");
}

}  // namespace

void add_force(console::Command command, bool& force) {
  advise(kUploadAdvice);
  command.add_flag("--force", force,
                   "upload also what is not shown to be better, a change of more\n"
                   "than 10 %, and what is of another robot, of another wheel or\n"
                   "on top of other parameters");
}

bool warn_of_far_changes(const robot::RemoteParameters& robot, const std::vector<robot::Change>& changes) {
  const std::vector<std::string> far = robot::far_changes(robot, changes);
  for (const std::string& clause : far) console::say("warning: " + clause);
  return !far.empty();
}

bool agreed(const robot::RemoteParameters& robot, const std::vector<robot::Change>& changes, bool yes,
            std::size_t unasked) {
  console::say(console::table(experiment::side_by_side(changes), "llrrr"));
  const bool far = warn_of_far_changes(robot, changes);
  if (yes || (changes.size() <= unasked && !far)) return true;
  return console::confirm(changes.size() == 1 ? "Put this value in force?"
                                              : fmt::format("Put these {} values in force?", changes.size()));
}

bool agreed_to_load(calibration::Verdict verdict, const LoadOptions& options) {
  const bool advised_against = experiment::advises_against(verdict);
  const bool may_ask = !options.yes && verdict != calibration::Verdict::worse && console::stdin_is_terminal();
  if (advised_against && !options.force && !may_ask) return false;
  return options.yes || console::confirm(advised_against ? "Load these into the robot all the same?"
                                                         : "Load these into the robot?");
}

LoadResult load_parameters(robot::Client& client, const robot::RemoteParameters& robot,
                           const experiment::ParameterFile& file, const LoadOptions& options) {
  const experiment::ParameterValues values = experiment::understood_by(robot.rows(), file.parameters);
  LoadResult loaded{robot::changes(robot, values), std::nullopt};
  if (loaded.changes.empty()) {
    save_tried_values(robot, values);
    return loaded;
  }
  console::say(console::table(experiment::side_by_side(loaded.changes), "llrrr"));
  for (const Remark& why :
       experiment::objections(robot, experiment::identity_of(client.robot()), file, loaded.changes)) {
    if (!options.force) throw Error(why);
    console::say("warning: " + why.sentence);
  }
  warn_of_far_changes(robot, loaded.changes);
  if (const std::string note = experiment::insignificance(loaded.changes, file.standard_errors);
      !note.empty())
    console::say(note);
  const bool advised_against = experiment::advises_against(file.verdict);
  if (advised_against) console::say("warning: " + file.verdict_sentence);
  if (!agreed_to_load(file.verdict, options)) {
    if (advised_against)
      console::say("nothing was changed: it is advised against (--force uploads all the same)");
    (advised_against ? loaded.advised_against : loaded.declined) = true;
    return loaded;
  }
  loaded.report = robot::upload(client, values);
  return loaded;
}

}  // namespace astro::commands
