#include "host/robot/parameters/upload.hpp"

#include <gmock/gmock.h>

#include "host/robot/client/robot_problem.hpp"
#include "host/robot/parameters/parameter_problem.hpp"
#include "tests/support/base/remarks.hpp"
#include "tests/support/links/fake_link.hpp"

namespace astro::robot {
namespace {

using std::chrono::seconds;
using support::Tells;
using test::FakeLink;

const std::map<std::string, Value> kCalibration{
    {"c_R", 1.002}, {"c_L", 0.998}, {"b", 0.2886}, {"robot_name", std::string("calibrated")}};

/// Another session stages something.
void prepare(FakeLink& link) {
  link.robot.parameter("c_R").value = {link.robot.parameter("c_R").info.id, 1 << 30, (1 << 30) + 5, {}, {}};
}

TEST(Upload, PutsTheNewSetInForceAndSaysSo) {
  FakeLink link;
  Client client(link);
  client.connect();
  prepare(link);
  const auto report = upload(client, kCalibration);
  EXPECT_EQ(report.active, ActiveSet::new_set);
  EXPECT_FALSE(report.link_dropped);
  EXPECT_EQ(link.robot.parameter("b").value.active, 288'600'000);
  ASSERT_EQ(report.values.size(), 4U);
  for (const auto& value : report.values) EXPECT_EQ(value.now, value.wanted);
  EXPECT_THAT(report.remark(), Tells(ActiveSet::new_set));
}

TEST(Upload, LeavesValuesAloneThatSomebodyElseStaged) {
  FakeLink link;
  Client client(link);
  client.connect();
  prepare(link);
  upload(client, {{"b", 0.3}});
  EXPECT_EQ(link.robot.parameter("c_R").value.active, 1 << 30);
}

TEST(Upload, BadValuesAndNamesChangeNothing) {
  FakeLink link;
  Client client(link);
  client.connect();
  EXPECT_THROW(upload(client, {{"b", 0.3}, {"c_R", 7.0}}), Error);
  EXPECT_THROW(upload(client, {{"b", 0.3}, {"no_such", 7.0}}), Error);
  EXPECT_EQ(link.robot.executed[protocol::StageParameter::kId], 0);
}

TEST(Upload, ARefusedSetLeavesTheOldOneAndNothingStaged) {
  FakeLink link;
  Client client(link);
  client.connect();
  EXPECT_THROW(upload(client, {{"b", 0.3}, {"polarity", 0.0}}), RobotRefused);
  EXPECT_EQ(link.robot.parameter("b").value.active, 290'000'000);
  EXPECT_EQ(link.robot.parameter("b").value.staged, 290'000'000);
}

TEST(Upload, ThatLosesTheStagingAreaSaysSoAndLeavesTheOtherSessionAlone) {
  for (const auto& [message, name] :
       {std::pair{protocol::StageParameter::kId, protocol::StageParameter::kName},
        std::pair{protocol::CommitParameters::kId, protocol::CommitParameters::kName}}) {
    const std::uint8_t lost_at = message;
    FakeLink link;
    Client client(link);
    client.connect();
    int reverts = 0;
    link.fate = [&](bool to_robot, std::uint8_t id) {
      if (to_robot && id == lost_at) link.robot.staging_is_ours = false;
      reverts += to_robot && id == protocol::RevertParameters::kId ? 1 : 0;
      return test::Fate::arrives;
    };
    try {
      upload(client, kCalibration);
      FAIL();
    } catch (const RobotRefused& refused) {
      EXPECT_EQ(refused.code(), protocol::ErrorCode::staging_lost);
      EXPECT_THAT(refused.remark(), Tells(RobotProblem::refused, name));
    }
    EXPECT_EQ(reverts, 1) << "the area is not taken back from the other session";
    EXPECT_EQ(link.robot.parameter("b").value.active, 290'000'000);
  }
}

struct Outcomes {
  int old_set = 0, new_set = 0;
};

/// Uploads while the link drops at frame `n`, for every n; the report must say which set the robot holds.
Outcomes drop_at_every_frame(bool restarts) {
  Outcomes outcomes;
  for (int n = 0;; ++n) {
    FakeLink link;
    Client client(link);
    client.connect();
    prepare(link);
    link.drop_at_frame = link.frames + n;
    link.restarts_on_drop = restarts;
    link.stays_away = seconds(1);
    const auto before = link.robot.parameters;
    const auto report = upload(client, kCalibration);
    if (!report.link_dropped) return outcomes;  // n is after the last frame

    const bool is_new = report.active == ActiveSet::new_set;
    ++(is_new ? outcomes.new_set : outcomes.old_set);
    for (std::size_t i = 0; i < before.size(); ++i) {
      const auto& held = link.robot.parameters[i];
      EXPECT_EQ(held.value.active, held.value.staged) << "nothing stays staged, frame " << n;
      const bool same = held.value.active == before[i].value.active;
      EXPECT_TRUE(is_new || same) << held.info.name.view() << ", frame " << n;
    }
    for (const auto& value : report.values) EXPECT_EQ(value.now, is_new ? value.wanted : value.before);
    EXPECT_EQ(link.robot.parameter("b").value.active, is_new ? 288'600'000 : 290'000'000) << "frame " << n;
    EXPECT_THAT(report.remark(), Tells(report.active, "link_dropped"));
  }
}

TEST(Upload, SaysWhichSetIsInForceAfterADropAtAnyFrame) {
  const Outcomes outcomes = drop_at_every_frame(false);
  // 5 rows x 2 requests, revert, 4 stages, commit, 5 reads; a request and a reply each. A drop before the
  // first change is made up for, so old are: revert, the stages, and the commit's request.
  EXPECT_EQ(outcomes.old_set, 11);
  EXPECT_EQ(outcomes.new_set, 20 + 1 + 10);
}

TEST(Upload, SaysWhichSetIsInForceAfterTheRobotLostPowerAtAnyFrame) {
  const Outcomes outcomes = drop_at_every_frame(true);
  EXPECT_EQ(outcomes.old_set, 11);
  EXPECT_EQ(outcomes.new_set, 20 + 1 + 10);
}

TEST(Upload, SaysThatTheSetIsWholeIfTheRobotDoesNotComeBack) {
  FakeLink link;
  Client client(link);
  client.connect();
  link.drop_at_frame = link.frames + 25;
  link.stays_away = seconds(3600);
  EXPECT_THAT([&] { upload(client, kCalibration, seconds(5)); },
              support::ThrowsTelling<LinkLost>(ParameterProblem::set_unknown));
}

}  // namespace
}  // namespace astro::robot
