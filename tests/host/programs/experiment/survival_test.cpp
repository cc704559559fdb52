#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/base/json.hpp"
#include "tests/support/programs/program.hpp"

// A host program that dies must not leave a robot driving, and the next one must find the robot as it is.
namespace astro {
namespace {

using support::astrolabe;

nlohmann::json info(const support::Simulator& simulator) {
  return support::parse_json(astrolabe({"info", "--port", simulator.port(), "--json"}).out);
}

TEST(Survival, ARobotWhoseHostIsKilledStopsByItselfAndServesTheNextHost) {
  for (const std::vector<std::string>& options :
       {std::vector<std::string>{}, std::vector<std::string>{"--fast"}}) {
    const support::Simulator simulator(options);  // real time, then as fast as the host keeps up
    support::Program drive({ASTROLABE_PROGRAM, "drive", "line", "500", "--port", simulator.port()});
    // The drive is under way. In fast motion no other program may ask the simulator: its clock goes on after
    // any request, also while the host that drives is late.
    if (options.empty())
      ASSERT_TRUE(support::eventually([&] { return info(simulator)["mode"] == "segment"; })) << drive.err();
    else
      poll(nullptr, 0, 500);
    ASSERT_TRUE(drive.running()) << drive.err();
    drive.send(SIGKILL);
    drive.wait();
    ASSERT_TRUE(support::eventually([&] { return info(simulator)["mode"] == "fault"; }))
        << info(simulator).dump();
    EXPECT_EQ(info(simulator)["faults"], nlohmann::json::array({"link_lost"}));
    const support::Outcome again = astrolabe({"drive", "line", "0.1", "--port", simulator.port()});
    EXPECT_EQ(again.code, 0) << again.err;
  }
}

}  // namespace
}  // namespace astro
