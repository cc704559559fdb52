#include "host/experiment/files/folder_sessions.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/base/temporary_folder.hpp"

namespace astro::experiment {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using Paths = std::vector<fs::path>;

TEST(FolderSessions, AreNamedAfterTheFolderOfEachFile) {
  EXPECT_THAT(sessions_by_folder(Paths{"/a/monday/1.csv", "/a/tuesday/1.csv", "/a/monday/2.csv"}),
              ElementsAre("monday", "tuesday", "monday"));
}

TEST(FolderSessions, OfFoldersWithOneNameAreToldApartByTheFoldersAbove) {
  EXPECT_THAT(sessions_by_folder(Paths{"/april/monday/1.csv", "/may/monday/1.csv", "/may/tuesday/1.csv"}),
              ElementsAre("april/monday", "may/monday", "may/tuesday"));
  // The one folder's whole path is the other's end.
  EXPECT_THAT(sessions_by_folder(Paths{"/monday/1.csv", "/may/monday/1.csv"}),
              ElementsAre("/monday", "may/monday"));
  EXPECT_THAT(sessions_by_folder(Paths{"/1.csv", "/monday/1.csv"}), ElementsAre("/", "monday"));
}

TEST(FolderSessions, AreTheSameHoweverTheFolderIsWritten) {
  test::TemporaryFolder folder;
  const fs::path monday = folder.path() / "monday";
  fs::create_directory(monday);
  fs::create_directory_symlink(monday, folder.path() / "link");
  EXPECT_THAT(
      sessions_by_folder(Paths{monday / "1.csv", monday / "." / "2.csv", folder.path() / "link" / "3.csv"}),
      ElementsAre("monday", "monday", "monday"));
}

TEST(FolderSessions, OfABagThatIsAFolderIsTheFolderAbove) {
  EXPECT_THAT(sessions_by_folder(Paths{"/monday/drive1", "/monday/drive2/"}),
              ElementsAre("monday", "monday"));
}

TEST(FolderSessions, AreOneOnlyIfBothWheelsAndTruthLieTogether) {
  const Paths logs{"/logs/1.csv", "/logs/2.csv"}, days{"/takes/monday/1.csv", "/takes/tuesday/2.csv"};
  EXPECT_THAT(sessions_by_folder(days, days), ElementsAre("monday", "tuesday"));
  EXPECT_THAT(sessions_by_folder(logs, days), ElementsAre("monday with logs", "tuesday with logs"));
  EXPECT_THAT(sessions_by_folder(days, logs), ElementsAre("logs with monday", "logs with tuesday"));
  EXPECT_THAT(sessions_by_folder(Paths{"/monday/wheels/1.csv", "/tuesday/wheels/1.csv"},
                                 Paths{"/monday/takes/1.csv", "/tuesday/takes/1.csv"}),
              ElementsAre("monday/takes with monday/wheels", "tuesday/takes with tuesday/wheels"));
}

TEST(FolderSessions, OfRecordingsAreThoseOfTheirFolderBelowTheOneThatWasRead) {
  const RunSet set{{"monday/line", "monday/square", "tuesday/line", "line"}, std::vector<recording::Run>(4)};
  EXPECT_THAT(sessions_by_folder(set, "/drives"), ElementsAre("monday", "monday", "tuesday", "drives"));
}

}  // namespace
}  // namespace astro::experiment
