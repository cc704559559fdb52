#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "host/experiment/analysis/calibration_file.hpp"
#include "tests/host/import/scans/carmen_text.hpp"
#include "tests/host/import/scans/scan_bag.hpp"
#include "tests/support/base/gzip.hpp"
#include "tests/support/base/json.hpp"
#include "tests/support/base/temporary_folder.hpp"
#include "tests/support/programs/program.hpp"

// `calibrate files --truth scan:FILE` and `calibrate bag` by the scans of a laser scanner on the robot.
namespace astro {
namespace {

using support::astrolabe;
using support::Outcome;
using testing::HasSubstr;

constexpr int kFailed = 1, kScansWrongUsage = 2, kScansNotBetter = 3;
constexpr calibration::WheelFactors kWrong{1.013, 1.007, 0.306};

class Scans : public testing::Test {
 protected:
  static lidar::SyntheticDrive driven(const calibration::WheelFactors& actual, bool mirrored = false) {
    lidar::Scanner scanner;
    scanner.beams = 180;
    scanner.view_rad = std::numbers::pi;
    scanner.period_s = 0.4;
    scanner.mirrored = mirrored;
    lidar::SyntheticDrive drive(lidar::furnished_room(), {actual, 2e-6}, scanner, 41);
    lidar::drive_both_ways(drive, 3);
    return drive;
  }
  std::string at(const std::string& name) const { return (folder_.path() / name).string(); }

  Outcome calibrated(const std::string& log, const std::vector<std::string>& more = {}) {
    std::vector<std::string> words{"calibrate",   "files",       "--wheels", log,     "--truth",
                                   "scan:" + log, "--wheelbase", "0.3",      "--json"};
    words.insert(words.end(), more.begin(), more.end());
    return astrolabe(words);
  }
  std::string log_of(const lidar::SyntheticDrive& drive) {
    const Bytes packed = support::gzip(importing::carmen_text(drive, true));
    std::ofstream(at("drive.log.gz"), std::ios::binary)
        .write(reinterpret_cast<const char*>(packed.data()), static_cast<std::streamsize>(packed.size()));
    return at("drive.log.gz");
  }

  test::TemporaryFolder folder_;
};

TEST_F(Scans, InALogCalibrateTheRobotAndWriteAFile) {
  const Outcome outcome = calibrated(log_of(driven(kWrong)), {"--out", at("calib.toml")});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const nlohmann::json json = support::parse_json(outcome.out);
  EXPECT_EQ(json["verdict"]["verdict"], "better");
  EXPECT_NEAR(json["b_m"].get<double>(), 0.306, 0.002);
  const experiment::ParameterFile file = experiment::read_parameter_file(at("calib.toml"));
  EXPECT_EQ(std::get<double>(file.parameters.at("c_R")), json["c_R"].get<double>());
  EXPECT_EQ(file.verdict, calibration::Verdict::better);
  EXPECT_EQ(file.loaded.at("b"), 0.3);
}

TEST_F(Scans, OfARobotThatIsRightEndWithTheCodeForNotBetter) {
  const Outcome outcome = calibrated(log_of(driven(lidar::kLoaded)), {"--out", at("calib.toml")});
  EXPECT_EQ(outcome.code, kScansNotBetter) << outcome.err;
  EXPECT_EQ(support::parse_json(outcome.out)["verdict"]["verdict"], "undecided");
}

TEST_F(Scans, ThatAreMirroredAreRefusedWithTheOptionsThatHelp) {
  const std::string log = log_of(driven(kWrong, true));
  const Outcome outcome = calibrated(log);
  EXPECT_EQ(outcome.code, kFailed);
  EXPECT_THAT(outcome.err, HasSubstr("--truth-mirrored yes"));
  EXPECT_EQ(calibrated(log, {"--truth-mirrored", "yes"}).code, 0);
}

TEST_F(Scans, InABagAreFoundByThemselves) {
  importing::write_scan_bag(at("drive.mcap"), driven(kWrong), {"/scan"}, 1'790'000'000'000'000'000);
  const Outcome outcome = astrolabe(
      {"calibrate", "bag", at("drive.mcap"), "--wheel-diameter", "0.066", "--wheelbase", "0.3", "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("scans of /scan"));
  EXPECT_NEAR(support::parse_json(outcome.out)["b_m"].get<double>(), 0.306, 0.002);
}

TEST_F(Scans, TakeNoOptionsThatWouldHaveNoEffect) {
  std::ofstream(at("x.log")) << "ODOM 0 0 0 0 0 0 1 h 1\n";
  for (const std::vector<std::string>& more : {std::vector<std::string>{"--up", "z"},
                                               {"--body", "A"},
                                               {"--sigma-xy", "0.001"},
                                               {"--truth-topic", "/pose"},
                                               {"--drives-backward"},
                                               {"--wheel-diameter", "0.084"},
                                               {"--joints", "l,r"},
                                               {"--tag-side", "0.1"}}) {
    const Outcome outcome = calibrated(at("x.log"), more);
    EXPECT_EQ(outcome.code, kScansWrongUsage) << more.front();
    EXPECT_THAT(outcome.err, HasSubstr(more.front()));
  }
  EXPECT_THAT(calibrated(at("x.log"), {"--scan-topic", "/scan"}).err, HasSubstr("leave out --scan-topic"));
}

TEST_F(Scans, ThatAreNotMirroredAreRefusedIfSomebodySaysThatTheyAre) {
  const Outcome outcome = calibrated(log_of(driven(kWrong)), {"--truth-mirrored", "yes"});
  EXPECT_EQ(outcome.code, kFailed);
  EXPECT_THAT(outcome.err, HasSubstr("leave out --truth-mirrored yes"));
}

TEST_F(Scans, InAFileThatHasNoneAreMissed) {
  std::ofstream(at("x.csv")) << "t,x\n1,2\n";
  const Outcome outcome = calibrated(at("x.csv"));
  EXPECT_EQ(outcome.code, kFailed);
  EXPECT_THAT(outcome.err, HasSubstr("x.csv' holds no scans"));
}

}  // namespace
}  // namespace astro
