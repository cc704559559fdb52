#include <gmock/gmock.h>

#include "tests/support/base/json.hpp"
#include "tests/support/programs/program.hpp"

// astrolabe faults --log: what stopped the robot, through restarts.
namespace astro {
namespace {

using nlohmann::json;
using support::astrolabe;
using support::Outcome;
using support::Simulator;
using testing::HasSubstr;

json log_of(const Simulator& simulator) {
  const Outcome outcome = astrolabe({"faults", "--log", "--json", "--port", simulator.port()});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  return support::parse_json(outcome.out);
}

void stop(const Simulator& simulator) {
  ASSERT_EQ(astrolabe({"stop", "--emergency", "--port", simulator.port()}).code, 0);
  // The robot writes the entry when it is at rest, some time later.
  ASSERT_TRUE(support::eventually([&] { return !log_of(simulator).empty(); }));
}

TEST(FaultLog, OfANewRobotIsAFriendlySentence) {
  const Simulator simulator;
  EXPECT_THAT(astrolabe({"faults", "--log", "--port", simulator.port()}).out, HasSubstr("is empty"));
  EXPECT_EQ(log_of(simulator), json::array());
}

TEST(FaultLog, IsATableForPeopleAndAListForPrograms) {
  const Simulator simulator;
  stop(simulator);
  const Outcome table = astrolabe({"faults", "--log", "--port", simulator.port()});
  EXPECT_EQ(table.code, 0) << table.err;
  for (const char* word : {"number", "start", "fault", "battery", "emergency_stop", "disarmed", "m/s"})
    EXPECT_THAT(table.out, HasSubstr(word));
  const json entry = log_of(simulator).at(0);
  EXPECT_EQ(entry["number"], 1);
  EXPECT_EQ(entry["start"], 1);
  EXPECT_EQ(entry["fault"], "emergency_stop");
  EXPECT_EQ(entry["mode"], "disarmed");
  EXPECT_GT(entry["time_s"], 0);
  EXPECT_NEAR(entry["battery_V"], 12.0, 0.1);
  EXPECT_EQ(entry["left_mps"], 0.0);
  EXPECT_EQ(entry["missed"], 0);
}

TEST(FaultLog, StaysThroughClearingAndARestartOfTheRobot) {
  const Simulator simulator;
  stop(simulator);
  EXPECT_EQ(astrolabe({"faults", "--clear", "--port", simulator.port()}).code, 0);
  EXPECT_EQ(astrolabe({"reboot", "--port", simulator.port()}).code, 0);
  EXPECT_EQ(astrolabe({"faults", "--port", simulator.port()}).out, "no fault is latched\n");
  EXPECT_EQ(log_of(simulator).size(), 1U);
}

TEST(FaultLog, FlashFileOfAnEarlierVersionIsFilledUp) {
  const test::TemporaryFolder folder;
  const std::string flash = folder.path() / "flash";
  std::ofstream(flash, std::ios::binary) << std::string(4 * 4096, '\xFF');
  Simulator simulator({"--fast", "--flash", flash});
  stop(simulator);
}

TEST(FaultLog, IsNotForClearing) { EXPECT_EQ(astrolabe({"faults", "--log", "--clear"}).code, 2); }

}  // namespace
}  // namespace astro
