#include <gmock/gmock.h>

#include <cstdlib>
#include <filesystem>

#include "tests/support/base/temporary_folder.hpp"
#include "tests/support/programs/program.hpp"
#include "tests/support/ros2/domain.hpp"

// `astrolabe selftest`: whether the program does its work on this computer.
namespace astro {
namespace {

using testing::HasSubstr;
using testing::Not;

class SelfTest : public testing::Test {
 protected:
  SelfTest() {
    setenv("ROS_DOMAIN_ID", std::to_string(support::test_domain()).c_str(), 1);
    setenv("TMPDIR", folder_.path().c_str(), 1);
  }
  ~SelfTest() override { unsetenv("TMPDIR"); }

  test::TemporaryFolder folder_;
};

TEST_F(SelfTest, PassesLineByLineAndLeavesNothingBehind) {
  const support::Outcome outcome = support::astrolabe({"selftest"});
  for (const char* check :
       {"calibration", "upload", "report", "bags", "tables", "tracker", "ROS 2", "viewers", "printed tags"})
    EXPECT_THAT(outcome.out, HasSubstr(std::string("PASS  ") + check));
  // A board that is plugged in and that this user may not open is a true failure of the computer.
  if (outcome.out.find("FAIL  serial port") == std::string::npos) {
    EXPECT_EQ(outcome.code, 0) << outcome.out << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("PASS: all"));
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder_.path()));
}

TEST_F(SelfTest, NamesWhatIsMissingAndWhatItIsForWithoutFailing) {
  support::Program program(
      {"/bin/sh", "-c", std::string("PATH=/nowhere exec '") + ASTROLABE_PROGRAM + "' selftest"});
  program.wait();
  EXPECT_THAT(program.out(), testing::AllOf(HasSubstr("----  ffmpeg"), HasSubstr("phone films"),
                                            HasSubstr("apt install ffmpeg"), HasSubstr("----  teensy loader"),
                                            Not(HasSubstr("FAIL  ffmpeg"))));
}

TEST_F(SelfTest, GoesOnAfterAFailureAndEndsWith1) {
  // No file may be larger than 64 kB, as on a disk that is full: recordings fail, and what needs none works.
  support::Program program(
      {"/bin/bash", "-c", std::string("ulimit -f 64; exec '") + ASTROLABE_PROGRAM + "' selftest"});
  EXPECT_EQ(program.wait(), 1);
  EXPECT_THAT(program.out(), testing::AllOf(HasSubstr("FAIL  calibration"), HasSubstr("FAIL  bags"),
                                            HasSubstr("PASS  tracker"), Not(HasSubstr("PASS: all"))));
  EXPECT_THAT(program.err(), HasSubstr("checks failed"));
  EXPECT_TRUE(std::filesystem::is_empty(folder_.path()));
}

TEST_F(SelfTest, WithoutARoomForItsFilesSaysSo) {
  setenv("TMPDIR", "/proc", 1);
  const support::Outcome outcome = support::astrolabe({"selftest"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("no folder can be made in '/proc'"));
}

}  // namespace
}  // namespace astro
