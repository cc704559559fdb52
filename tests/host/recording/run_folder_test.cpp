#include "host/recording/run_folder.hpp"

#include <gmock/gmock.h>

#include "host/base/error.hpp"
#include "host/base/text/natural_order.hpp"
#include "host/recording/recording_problem.hpp"
#include "host/recording/run_file.hpp"
#include "tests/host/recording/support.hpp"
#include "tests/support/base/remarks.hpp"

namespace astro::recording {
namespace {

using astro::support::ThrowsTelling;
using support::TempFolder;
using ::testing::AllOf;
using ::testing::ElementsAre;

Run numbered(int index) {
  recording::Run run;
  run.info.index = index;
  run.odometry.resize(static_cast<std::size_t>(index));
  return run;
}

TEST(RunFolder, RunsComeInNaturalOrderFromEveryDepth) {
  const TempFolder folder;
  write_run(folder / "before/cw-10.mcap", numbered(4));
  write_run(folder / "before/cw-2.mcap", numbered(3));
  write_run(folder / "after/cw-1.mcap", numbered(1));
  write_run(folder / "after/cw-1b.mcap", numbered(2));
  support::spill(folder / "notes.txt", as_bytes("not a run"));
  support::spill(folder / "before/cw-3.mcap.part", as_bytes("cut off"));
  std::vector<int> indices;
  for (const recording::Run& run : read_runs(folder.path())) {
    indices.push_back(run.info.index);
    EXPECT_EQ(run.odometry.size(), indices.size());
  }
  EXPECT_THAT(indices, ElementsAre(1, 2, 3, 4));
}

TEST(RunFolder, NaturalOrderIsAStrictOrder) {
  const std::vector<std::string> sorted = {"",
                                           "a",
                                           "a/1",
                                           "a/01",
                                           "a1",
                                           "a1b",
                                           "a2",
                                           "a09",
                                           "a10",
                                           "a99999999999999999999",
                                           "a100000000000000000000",
                                           "b",
                                           "b-1"};
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    for (std::size_t j = 0; j < sorted.size(); ++j) {
      if (sorted[i] == "a/1" || sorted[i] == "a/01") continue;  // equal as numbers: ordered as text
      if (sorted[j] == "a/1" || sorted[j] == "a/01") continue;
      EXPECT_EQ(natural_less(sorted[i], sorted[j]), i < j) << sorted[i] << " " << sorted[j];
    }
  }
  EXPECT_NE(natural_less("a/1", "a/01"), natural_less("a/01", "a/1"));
}

TEST(RunFolder, ErrorsNameTheFolderOrTheFile) {
  const TempFolder folder;
  EXPECT_THAT([&] { list_runs(folder / "none"); },
              ThrowsTelling(RecordingProblem::folder_missing, (folder / "none").string()));
  EXPECT_THAT([&] { read_runs(folder.path()); },
              ThrowsTelling(RecordingProblem::none_in_folder, folder.path().string()));
  support::spill(folder / "x/bad.mcap", as_bytes("nonsense"));
  EXPECT_THAT([&] { read_runs(folder.path()); },
              ThrowsTelling(RecordingProblem::not_mcap, (folder / "x/bad.mcap").string()));
}

}  // namespace
}  // namespace astro::recording
