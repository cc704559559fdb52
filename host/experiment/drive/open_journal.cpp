#include "host/experiment/drive/open_journal.hpp"

#include <nlohmann/json.hpp>

#include "host/base/error.hpp"
#include "host/base/utc.hpp"
#include "host/experiment/files/robot_identity.hpp"
#include "host/robot/client/handshake.hpp"

namespace astro::experiment {
namespace {

void require_same(const std::filesystem::path& folder, const Journal& journal, const Plan& plan,
                  const RobotIdentity& identity) {
  Plan same = plan;
  // Nobody chooses these, and an experiment that an older version began goes on with its own.
  same.circles = journal.plan.circles;
  same.circle_turns = journal.plan.circle_turns;
  if (nlohmann::json(journal.plan) != nlohmann::json(same))
    throw Error("'" + folder.string() + "' holds an experiment with other settings",
                {Help::give_same_settings_or_choose_other_out_folder});
  if (const std::string other = different_robots("the experiment in '" + folder.string() + "'",
                                                 {journal.robot_name, journal.robot_id}, "this", identity);
      !other.empty())
    throw Error(other, {Help::choose_other_out_folder});
}

}  // namespace

Journal open_journal(const std::filesystem::path& folder, const Plan& plan, const robot::Client& client) {
  const protocol::HelloReply& robot = client.robot();
  const RobotIdentity identity = identity_of(robot);
  if (has_journal(folder)) {
    Journal journal = read_journal(folder);
    require_same(folder, journal, plan, identity);
    return journal;
  }
  Journal journal;
  journal.plan = plan;
  journal.robot_id = identity.id;
  journal.robot_name = identity.name;
  journal.board = robot.board.view();
  journal.firmware = robot::firmware_version(robot);
  journal.started_at = utc_now();
  write_journal(folder, journal);
  return journal;
}

}  // namespace astro::experiment
