#include <gtest/gtest.h>

#include "tests/support/base/json.hpp"
#include "tests/support/base/thorough.hpp"
#include "tests/target/program/emulator.hpp"

namespace astro::target {
namespace {

using nlohmann::json;

json umbmark(const std::string& port, const std::filesystem::path& out) {
  const support::Outcome outcome =
      support::astrolabe({"umbmark", "--port", port, "--truth", "sim", "--runs", "1", "--side", "3",
                          "--rounds", "1", "--no-extras", "--out", out.string(), "--yes", "--json"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  return outcome.code == 0 ? support::parse_json(outcome.out) : json();
}

// No slip: then one run each way round says what twenty would, and the improvement is the method's.
TEST(ExperimentOverAPty, CalibratesTheImageAsItCalibratesTheSimulatedRobot) {
  if (!support::thorough()) GTEST_SKIP() << support::kLeftToThorough;
  const std::vector<std::string> robot{"--slip", "0", "--seed", "1"};
  std::vector<std::string> simulated_robot = robot;
  simulated_robot.emplace_back("--fast");
  const support::PatientSimulator simulator(simulated_robot);
  const json simulated = umbmark(simulator.port(), simulator.folder() / "x");
  const EmulatorProgram emulator(robot);
  support::forgive_late_hosts(emulator.usb());
  const json emulated = umbmark(emulator.usb(), emulator.folder() / "x");
  ASSERT_FALSE(simulated.empty() || emulated.empty());
  const auto E_mm = [](const json& result, const char* phase) {
    return 1000 * result[phase]["E_max_syst_m"].get<double>();
  };
  std::printf(
      "over a pty: E_max_syst of the simulated robot %.1f -> %.2f mm, of the emulated Teensy %.1f -> %.2f "
      "mm\n",
      E_mm(simulated, "before"), E_mm(simulated, "after"), E_mm(emulated, "before"), E_mm(emulated, "after"));
  EXPECT_NEAR(E_mm(emulated, "before"), E_mm(simulated, "before"), 5);  // cameras: 1 mm and 1 mrad at 4 m
  EXPECT_LT(E_mm(emulated, "after"), E_mm(emulated, "before") / 30);    // what the simulated robot must reach
  for (const char* name : {"c_R", "c_L"})
    EXPECT_NEAR(emulated["parameters"]["new"][name], simulated["parameters"]["new"][name].get<double>(),
                1e-3);
}

}  // namespace
}  // namespace astro::target
