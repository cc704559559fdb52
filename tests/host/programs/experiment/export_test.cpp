#include <gmock/gmock.h>

#include <fstream>
#include <sstream>

#include "host/recording/run_file.hpp"
#include "tests/support/base/temporary_folder.hpp"
#include "tests/support/programs/program.hpp"

// `astrolabe export`.
namespace astro {
namespace {

namespace fs = std::filesystem;
using support::astrolabe;
using support::Outcome;
using testing::HasSubstr;

std::string text_of(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

recording::Run run_that_ends_at(double x_m) {
  recording::Run run;
  run.info.kind = "line";
  run.odometry = {{1'000'000, 0, 0, 0, 0, 0, 0, 0}, {1'500'000, x_m, 0, 0, 0.5, 0, 7, 8}};
  run.truth = {{1'000'000, 0, 0, 0, true}, {1'500'000, x_m, 0, 0, true}};
  return run;
}

TEST(ExportCommand, WritesTheTablesOfARecording) {
  const test::TemporaryFolder temporary;
  const fs::path folder = temporary.path();
  write_run(folder / "drive.mcap", run_that_ends_at(0.25));
  const Outcome outcome =
      astrolabe({"export", (folder / "drive.mcap").string(), "--csv", (folder / "csv").string()});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr((folder / "csv").string()));
  EXPECT_THAT(text_of(folder / "csv/odometry.csv"), HasSubstr("\n1.500000,0.25,0,0,0.5,0,7,8\n"));
  EXPECT_THAT(text_of(folder / "csv/truth.csv"), HasSubstr("\n1.500000,0.25,0,0,1\n"));
}

TEST(ExportCommand, ReplacesItsOwnTablesAndNoOthers) {
  const test::TemporaryFolder temporary;
  const fs::path folder = temporary.path();
  write_run(folder / "drive.mcap", run_that_ends_at(0.25));
  const auto exported = [&](const char* option) {
    return astrolabe({"export", (folder / "drive.mcap").string(), option, (folder / "out").string()});
  };
  for (const char* option : {"--csv", "--tum"})
    for (int again = 0; again < 2; ++again) EXPECT_EQ(exported(option).code, 0) << option;
  for (const char* name : {"truth.csv", "truth.tum"}) std::ofstream(folder / "out" / name) << "1 2 3\n";
  EXPECT_THAT(exported("--csv").err, HasSubstr("truth.csv' exists and is no export of this program"));
  EXPECT_THAT(exported("--tum").err, HasSubstr("truth.tum' exists and is no export of this program"));
  EXPECT_EQ(text_of(folder / "out/truth.csv"), "1 2 3\n");
}

TEST(ExportCommand, GivesEachRecordingOfAFolderAFolderOfItsOwn) {
  const test::TemporaryFolder temporary;
  const fs::path folder = temporary.path();
  fs::create_directories(folder / "runs/before");
  write_run(folder / "runs/before/line-1.mcap", run_that_ends_at(1));
  write_run(folder / "runs/line-1.mcap", run_that_ends_at(2));
  const Outcome outcome =
      astrolabe({"export", (folder / "runs").string(), "--csv", (folder / "csv").string()});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(text_of(folder / "csv/before/line-1/odometry.csv"), HasSubstr("1.500000,1,"));
  EXPECT_THAT(text_of(folder / "csv/line-1/odometry.csv"), HasSubstr("1.500000,2,"));
}

TEST(ExportCommand, NamesWhatIsNoRecordingAndWritesNothing) {
  const test::TemporaryFolder temporary;
  const fs::path folder = temporary.path();
  std::ofstream(folder / "drive.mcap") << "no recording";
  const Outcome outcome =
      astrolabe({"export", (folder / "drive.mcap").string(), "--csv", (folder / "csv").string()});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("drive.mcap"));
  EXPECT_FALSE(fs::exists(folder / "csv"));
}

}  // namespace
}  // namespace astro
