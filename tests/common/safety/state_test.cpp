#include "common/safety/state.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace astro {
namespace {

const std::vector<State> kAll{State::boot,    State::disarmed, State::armed,
                              State::driving, State::stopping, State::fault};
const std::vector<Event> kEverything{Event::proven, Event::arm,  Event::disarm, Event::drive,
                                     Event::stop,   Event::rest, Event::fault,  Event::clear};

State after(State state, Event event) {
  advance(state, event);
  return state;
}

TEST(State, OnlyDrivingAndStoppingGivePower) {
  for (const State state : kAll)
    EXPECT_EQ(permission(state) == Permission::drive, state == State::driving || state == State::stopping);
}

TEST(State, TheBridgesAreOpenUnlessTheRobotIsArmed) {
  for (const State state : {State::boot, State::disarmed, State::fault})
    EXPECT_EQ(permission(state), Permission::open);
}

TEST(State, AFaultEndsInTheStateOfThatNameFromAnywhere) {
  for (const State state : kAll) EXPECT_EQ(after(state, Event::fault), State::fault);
}

TEST(State, OutOfAFaultLeadsNothingButClearingAndThatIsNotArmed) {
  for (const Event event : kEverything)
    EXPECT_EQ(after(State::fault, event), event == Event::clear ? State::disarmed : State::fault);
}

TEST(State, OnlyArmingArmsAndOnlyADriveDrives) {
  for (const State state : {State::boot, State::disarmed, State::fault})
    for (const Event event : kEverything) {
      const State then = after(state, event);
      EXPECT_NE(permission(then), Permission::drive);
      EXPECT_TRUE(then != State::armed || (state == State::disarmed && event == Event::arm));
    }
  for (const Event event : kEverything)
    EXPECT_EQ(after(State::armed, event) == State::driving, event == Event::drive);
}

TEST(State, BootIsLeftByProofOrFaultAlone) {
  for (const Event event : kEverything)
    EXPECT_EQ(after(State::boot, event), event == Event::proven  ? State::disarmed
                                         : event == Event::fault ? State::fault
                                                                 : State::boot);
}

TEST(State, DisarmingTakesAllPowerAway) {
  for (const State state : kAll) EXPECT_EQ(permission(after(state, Event::disarm)), Permission::open);
}

TEST(State, ARefusedEventChangesNothing) {
  for (const State state : kAll)
    for (const Event event : kEverything) {
      State then = state;
      const bool taken = advance(then, event);
      EXPECT_TRUE(taken || then == state);
    }
}

}  // namespace
}  // namespace astro
