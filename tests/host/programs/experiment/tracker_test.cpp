#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <csignal>
#include <utility>

#include "tests/support/base/json.hpp"
#include "tests/support/programs/program.hpp"

// Ground truth by VRPN from a simulator's virtual tracker, in real time, as from a lab's.
namespace astro {
namespace {

namespace fs = std::filesystem;
using support::astrolabe;
using support::PatientSimulator;
using support::Simulator;
using testing::HasSubstr;

/// "vrpn://127.0.0.1:PORT/ASTRO", as the simulator said it.
std::string address_of(Simulator& simulator, const std::string& protocol = "vrpn") {
  const std::string said = simulator.program().err();
  const std::size_t at = said.find(protocol + "://");
  return at == std::string::npos ? "" : said.substr(at, said.find('\n', at) - at);
}

/// A recorder in the background, which has begun when constructed.
struct Recorder {
  Recorder(const Simulator& simulator, const std::string& truth, const std::string& name)
      : folder(simulator.folder() / name),
        program({ASTROLABE_PROGRAM, "record", "--port", simulator.port(), "--truth", truth, "--out",
                 (fs::create_directory(folder), (folder / "run.mcap").string())}) {
    EXPECT_TRUE(support::eventually([&] {
      return program.err().find("recording; Ctrl-C ends it") != std::string::npos;
    })) << program.err();
  }
  nlohmann::json calibration() {
    program.send(SIGINT);
    EXPECT_EQ(program.wait(), 0) << program.err();
    const support::Outcome outcome = astrolabe({"calibrate", "runs", folder.string(), "--json"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return support::parse_json(outcome.out);
  }
  fs::path folder;
  support::Program program;
};

TEST(TrackerOnTheNetwork, IsNotServedFasterThanTime) {
  const support::Outcome outcome = astrolabe({"sim", "--fast", "--vrpn-port", "0"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("leave it out, or --vrpn-port"));
}

TEST(TrackerOnTheNetwork, GivesTheFactorsThatTheSimulatorsOwnTruthGives) {
  PatientSimulator simulator({"--vrpn-port", "0", "--natnet-port", "0", "--tracker-latency", "0.03",
                              "--tracker-ahead", "0.08", "--tracker-left", "-0.03", "--tracker-drops", "0.1",
                              "--slip", "2.645e-6", "--true-ed", "1.00416", "--seed", "5"});
  ASSERT_TRUE(support::eventually([&] { return !address_of(simulator, "natnet").empty(); }));
  Recorder tracked(simulator, address_of(simulator), "vrpn"), own(simulator, "sim", "sim"),
      optitrack(simulator, address_of(simulator, "natnet"), "natnet");
  ASSERT_EQ(astrolabe({"drive", "square", "0.4", "--ccw", "--port", simulator.port()}).code, 0);
  const nlohmann::json vrpn = tracked.calibration(), sim = own.calibration(),
                       natnet = optitrack.calibration();
  EXPECT_THAT(tracked.program.err(), HasSubstr("'ASTRO' from 127.0.0.1:"));
  EXPECT_THAT(tracked.program.err(),
              testing::ContainsRegex("(59|60)\\.[0-9] poses per second, times by the tracker's clock"));
  // Both saw the same drive with the same noise, so wheel slip, the greatest part of the error, is common. What
  // differs is 10 % of the poses, and the offset of the clocks, which only one of them had to find.
  for (const char* factor : {"c_R", "c_L", "b_m"}) {
    const double error = sim["standard_errors"][factor], own_value = sim[factor];
    const double by_vrpn = vrpn[factor].get<double>() - own_value,
                 by_natnet = natnet[factor].get<double>() - own_value;
    std::printf("  %s: %.2f and %.2f standard errors apart\n", factor, by_vrpn / error, by_natnet / error);
    EXPECT_LE(std::abs(by_vrpn), 0.5 * error) << factor;
    EXPECT_LE(std::abs(by_natnet), 0.5 * error) << factor;
  }
  for (const auto& [axis, true_m] : {std::pair{"x_m", 0.08}, {"y_m", -0.03}})
    EXPECT_NEAR(vrpn["sessions"][0]["lever_arm"][axis].get<double>(), true_m,
                4 * vrpn["sessions"][0]["lever_arm_se"][axis].get<double>())
        << axis;
}

/// A whole experiment in the background, with a robot of its own that slips like the thesis's.
struct WholeExperiment {
  explicit WholeExperiment(const std::string& truth)
      : simulator({"--vrpn-port", "0", "--natnet-port", "0", "--tracker-latency", "0.03", "--tracker-drops",
                   "0.1", "--slip", "2.645e-6", "--true-ed", "1.00416", "--seed", "7"}),
        program({ASTROLABE_PROGRAM, "umbmark", "--port", simulator.port(), "--truth",
                 truth == "sim" ? truth : served(truth), "--runs", "1", "--side", "0.4", "--no-extras",
                 "--yes", "--force", "--out", (simulator.folder() / "lab").string(), "--json"}) {}

  nlohmann::json calibration() {
    const int code = program.wait();
    EXPECT_EQ(code, 0) << program.err();
    return support::parse_json(program.out())["phases"][0]["estimate"];
  }

  std::string served(const std::string& protocol) {
    EXPECT_TRUE(support::eventually([&] { return !address_of(simulator, protocol).empty(); }));
    return address_of(simulator, protocol);
  }

  PatientSimulator simulator;
  support::Program program;
};

TEST(TrackerOnTheNetwork, CalibratesInAWholeExperimentAsTheSimulatorsOwnTruthDoes) {
  WholeExperiment own("sim"), by_vrpn("vrpn"), by_natnet("natnet");
  const nlohmann::json sim = own.calibration(), vrpn = by_vrpn.calibration(),
                       natnet = by_natnet.calibration();
  for (const char* factor : {"c_R", "c_L", "b_m"})
    for (const nlohmann::json* tracked : {&vrpn, &natnet}) {
      const double error = std::hypot(sim["standard_errors"][factor].get<double>(),
                                      (*tracked)["standard_errors"][factor].get<double>());
      const double apart = ((*tracked)[factor].get<double>() - sim[factor].get<double>()) / error;
      std::printf("  %s by %s: %.2f standard errors apart\n", factor, tracked == &vrpn ? "VRPN" : "NatNet",
                  apart);
      // The robots slip alike as long as commands reach them at the same ticks, and then a few hundredths is seen. Where a
      // command comes a tick later, this is a draw from a normal distribution.
      EXPECT_LE(std::abs(apart), 3) << factor;
    }
}

TEST(TrackerOnTheNetwork, ABodyThatItDoesNotKnowIsAnErrorThatListsThoseThatItDoes) {
  Simulator simulator({"--vrpn-port", "0"});
  ASSERT_TRUE(support::eventually([&] { return !address_of(simulator).empty(); }));
  const std::string address = address_of(simulator);
  const support::Outcome outcome = astrolabe({"record", "--port", simulator.port(), "--truth",
                                              address.substr(0, address.rfind('/')) + "/ROBOT", "--seconds",
                                              "1", "--out", (simulator.folder() / "x.mcap").string()});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("it knows no 'ROBOT'; it has described 'ASTRO'"));
}

TEST(TrackerOnTheNetwork, IsWatchedLive) {
  Simulator simulator({"--vrpn-port", "0"});
  ASSERT_TRUE(support::eventually([&] { return !address_of(simulator).empty(); }));
  const support::Outcome outcome =
      astrolabe({"truth", "watch", address_of(simulator), "--seconds", "4", "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("'ASTRO' over TCP"));
  const std::size_t last = outcome.out.rfind('\n', outcome.out.size() - 2) + 1;
  const nlohmann::json report = support::parse_json(outcome.out.substr(last));
  EXPECT_NEAR(report["rate_hz"].get<double>(), 60, 1);
  EXPECT_EQ(report["lost"], 0);
  // The cameras of the simulator have 0.2 mm and 1 mrad; the robot stands. Of 180 poses they are good to 5 %.
  EXPECT_NEAR(report["noise_at_rest"]["position_m"].get<double>(), 2e-4, 4e-5);
  EXPECT_NEAR(report["noise_at_rest"]["heading_rad"].get<double>(), 1e-3, 2e-4);
}

TEST(TrackerOnTheNetwork, AWatchOfNothingEndsWithTheReason) {
  const support::Outcome outcome =
      astrolabe({"truth", "watch", "vrpn://127.0.0.1:1/ASTRO", "--seconds", "1"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("no ground truth came from 127.0.0.1:1: nothing answers there"));
}

TEST(TrackerOnTheNetwork, AnAddressThatIsNoneIsWrongUsage) {
  for (const char* address :
       {"vrpn:/lab", "vrpn://", "vrpn://lab:0/ASTRO", "vrpn://lab/ASTRO?up=x", "tape"}) {
    const support::Outcome outcome = astrolabe({"record", "--truth", address, "--out", "/tmp/x.mcap"});
    EXPECT_EQ(outcome.code, 2) << address;
    EXPECT_THAT(outcome.err, testing::AllOf(HasSubstr("--truth"), HasSubstr(address)));
  }
}

}  // namespace
}  // namespace astro
