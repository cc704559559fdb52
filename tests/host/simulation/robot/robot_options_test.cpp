#include "host/simulation/robot/robot_options.hpp"

#include <gmock/gmock.h>

#include <set>

#include "host/base/error.hpp"

namespace astro::simulation {
namespace {

using testing::HasSubstr;

/// The flags of a wiring, in the order in which hal/sim/config.hpp declares them.
std::string flags(const sim::Wiring& w) {
  std::string text;
  for (const bool flag :
       {w.left_motor_reversed, w.right_motor_reversed, w.motors_swapped, w.left_encoder_reversed,
        w.right_encoder_reversed, w.encoders_swapped, w.left_motor_dead, w.right_motor_dead,
        w.left_encoder_dead, w.right_encoder_dead, w.left_channel_lost, w.right_channel_lost})
    text += flag ? '1' : '0';
  return text;
}

std::vector<std::string> all_faults() {
  std::vector<std::string> names(1);
  for (const char c : wiring_fault_names() + ", ") {
    if (c == ',')
      names.emplace_back();
    else if (c != ' ')
      names.back() += c;
  }
  names.pop_back();
  return names;
}

TEST(RobotOptions, AreTheReferenceRobotUnlessTheySayOtherwise) {
  const sim::Config robot = config_of({}), plain;
  EXPECT_DOUBLE_EQ(robot.true_ed, 1.00416);
  EXPECT_DOUBLE_EQ(robot.true_wheelbase_m, 0.99521 * plain.nominal_wheelbase_m);
  EXPECT_EQ(robot.slip_m, plain.slip_m);
  EXPECT_EQ(robot.seed, plain.seed);
  EXPECT_EQ(flags(robot.wiring), flags(plain.wiring));
  EXPECT_FALSE(robot.wall);
}

TEST(RobotOptions, EachWiringFaultIsOneOfTheBoard) {
  std::set<std::string> seen;
  for (const std::string& name : all_faults()) {
    EXPECT_EQ(wrong_wiring_fault(name), "");
    const std::string wired = flags(config_of({.wiring_faults = {name}}).wiring);
    EXPECT_EQ(std::ranges::count(wired, '1'), 1) << name;
    EXPECT_TRUE(seen.insert(wired).second) << name;
  }
  EXPECT_EQ(seen.size(), flags({}).size());
}

TEST(RobotOptions, FaultsAddUp) {
  const sim::Wiring wired = config_of({.wiring_faults = {"motors-swapped", "encoders-swapped"}}).wiring;
  EXPECT_TRUE(wired.motors_swapped);
  EXPECT_TRUE(wired.encoders_swapped);
}

TEST(RobotOptions, AnUnknownFaultIsNamed) {
  EXPECT_THAT(wrong_wiring_fault("loose"),
              HasSubstr("'loose' is not a wiring fault; choose from left-motor-reversed,"));
  EXPECT_THROW(config_of({.wiring_faults = {"loose"}}), Error);
}

TEST(RobotOptions, AWallStandsBeforeTheFront) {
  const sim::Config robot = config_of({.wall_ahead_m = 0.5});
  EXPECT_DOUBLE_EQ(robot.wall.value().x_m, robot.body.ahead_m + 0.5);
}

}  // namespace
}  // namespace astro::simulation
