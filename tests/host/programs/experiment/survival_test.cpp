#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/robots/watched_drive.hpp"

// A host program that dies must not leave a robot driving, and the next one must find the robot as it is.
namespace astro {
namespace {

using Options = std::vector<std::string>;

/// In real time, or as fast as the host keeps up.
class Survival : public support::WatchedDrive, public testing::WithParamInterface<const char*> {
 protected:
  Survival() : WatchedDrive(GetParam() == std::string("Fast") ? Options{"--fast"} : Options{}) {}
};

INSTANTIATE_TEST_SUITE_P(Of, Survival, testing::Values("Fast", "InRealTime"),
                         [](const auto& pace) { return std::string(pace.param); });

TEST_P(Survival, ARobotWhoseHostIsKilledStopsByItselfAndServesTheNextHost) {
  // Three hours. In fast motion no other program may ask whether it has begun: the simulator's clock goes on after any request,
  // also while the host that drives is late.
  support::Program program = drive({"line", "1000", "--speed", "0.1"});
  ASSERT_TRUE(has_gone(0.1)) << program.err();
  program.send(SIGKILL);
  program.wait();
  ASSERT_TRUE(support::eventually([&] { return info()["mode"] == "fault"; })) << info().dump();
  EXPECT_EQ(info()["faults"], nlohmann::json::array({"link_lost"}));
  const support::Outcome again = support::astrolabe({"drive", "line", "0.1", "--port", simulator_.port()});
  EXPECT_EQ(again.code, 0) << again.err;
}

}  // namespace
}  // namespace astro
