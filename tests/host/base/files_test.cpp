#include "host/base/files.hpp"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <fstream>
#include <system_error>

#include "host/base/file_problem.hpp"
#include "host/base/folder_lock.hpp"
#include "host/recording/recording_problem.hpp"
#include "host/recording/run_folder.hpp"
#include "tests/host/recording/support.hpp"
#include "tests/support/base/bounded.hpp"
#include "tests/support/base/remarks.hpp"

namespace astro::recording {
namespace {

using astro::support::ThrowsTelling;
using support::TempFolder;

constexpr std::uint8_t kBytes[] = {1, 2, 3};

TEST(PartFile, LeavesWhatWasWrittenButNothingThatIsEmpty) {
  const TempFolder folder;
  { const PartFile begun(folder / "nothing"); }
  EXPECT_FALSE(std::filesystem::exists(folder / "nothing.part"));
  { PartFile(folder / "some").write(kBytes); }
  EXPECT_EQ(std::filesystem::file_size(folder / "some.part"), 3U);
}

TEST(PartFile, RefusesTheNameOfAFolderBeforeAnythingIsWritten) {
  const TempFolder folder;
  EXPECT_THAT([&] { PartFile(folder.path()).commit(); },
              ThrowsTelling(FileProblem::is_folder, folder.path().string()));
  EXPECT_FALSE(std::filesystem::exists(folder.path().string() + ".part"));
}

TEST(RequireOwnKind, LetsOnlyFilesWithTheMarkBeReplacedAndEmptyOnes) {
  const TempFolder folder;
  const auto replace = [&](const std::string& text) {
    std::ofstream(folder / "out") << text;
    require_own_kind(folder / "out", "# ours", "report");
  };
  EXPECT_NO_THROW(require_own_kind(folder / "none", "# ours", "report"));
  EXPECT_NO_THROW(replace(""));
  EXPECT_NO_THROW(replace("title\n# ours\n"));
  EXPECT_THAT([&] { replace("t_s,left,right\n"); },
              ThrowsTelling(FileProblem::of_other_kind, (folder / "out").string(), "report"));
}

TEST(RequireNoInput, KnowsAnInputUnderAnotherName) {
  const TempFolder folder;
  std::ofstream(folder / "in") << "1";
  std::filesystem::create_symlink(folder / "in", folder / "link");
  EXPECT_THAT(([&] {
                require_no_input(folder / "link", {folder / "other", folder / "in"});
              }),
              ThrowsTelling(FileProblem::is_input, (folder / "link").string()));
  EXPECT_NO_THROW(require_no_input(folder / "new", {folder / "in", {}}));
}

TEST(LoadText, RefusesASparseFileOfAGigabyteAtItsFirstHole) {
  const TempFolder folder;
  std::ofstream(folder / "sparse.csv") << "ex_mm,ey_mm\n1,2\n";
  std::filesystem::resize_file(folder / "sparse.csv", std::uintmax_t{1} << 30);
  const auto taken = astro::support::measured([&] {
    EXPECT_THAT([&] { load_text(folder / "sparse.csv"); },
                ThrowsTelling(FileProblem::not_plain_text, (folder / "sparse.csv").string(), "17"));
  });
  EXPECT_BOUNDED(taken, 0);
}

TEST(LoadText, RefusesALineThatIsLongerThanAnyTableHas) {
  const TempFolder folder;
  std::ofstream(folder / "long.csv") << "ex_mm\r" << std::string(200 << 20, '1');
  const auto taken = astro::support::measured([&] {
    EXPECT_THAT([&] { load_text(folder / "long.csv"); },
                ThrowsTelling(FileProblem::line_too_long, (folder / "long.csv").string(), "7"));
  });
  EXPECT_TRUE(taken.ended);
  if (astro::support::kMeasuresMemory) {
    EXPECT_LE(taken.peak_bytes, std::size_t{16} << 20);
  }
}

TEST(LoadText, IsTheWholeFileHoweverManyBlocksItTakes) {
  const TempFolder folder;
  std::string text;
  while (text.size() < (3U << 20)) text += std::to_string(text.size()) + ",2,3\r\n";
  std::ofstream(folder / "table.csv", std::ios::binary) << text;
  EXPECT_EQ(as_text(load_text(folder / "table.csv")), text);
  EXPECT_EQ(as_text(load_file(folder / "table.csv")), text);
  EXPECT_THAT([&] { load_file(folder / "table.csv", kMaxSettingsBytes); },
              ThrowsTelling(FileProblem::too_large, (folder / "table.csv").string(),
                            std::to_string(text.size()), "1048576"));
}

TEST(PartFile, ReplacesNoRecording) {
  const TempFolder folder;
  constexpr std::uint8_t kRecording[] = {0x89, 'M', 'C', 'A', 'P', '0', '\r', '\n'};
  for (const char* name : {"run.mcap", "run.html"}) {
    PartFile first(folder / name);
    first.write(kRecording);
    first.commit();
    EXPECT_THAT([&] { PartFile(folder / name).commit(); },
                ThrowsTelling(FileProblem::is_recording, (folder / name).string()));
    EXPECT_EQ(std::filesystem::file_size(folder / name), sizeof kRecording);
  }
}

TEST(PartFile, NeedsNoFolderInItsName) {
  const TempFolder folder;
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(folder.path());
  EXPECT_NO_THROW(PartFile("alone").commit());
  std::filesystem::current_path(before);
  EXPECT_TRUE(std::filesystem::exists(folder / "alone"));
}

TEST(PartFile, AnEmptyFileIsAFileOnceItIsCommitted) {
  const TempFolder folder;
  PartFile(folder / "empty").commit();
  EXPECT_TRUE(std::filesystem::is_empty(folder / "empty"));
}

TEST(PartFile, IsNeverOpenedThroughALink) {
  const TempFolder folder;
  support::spill(folder / "precious", kBytes);
  std::filesystem::create_symlink(folder / "precious", folder / "run.part");
  EXPECT_THAT([&] { PartFile(folder / "run").commit(); },
              ThrowsTelling(FileProblem::is_link, (folder / "run.part").string()));
  EXPECT_EQ(load_file(folder / "precious").size(), sizeof kBytes);
}

TEST(PartFile, MayLieInAFolderThatIsALink) {
  const TempFolder folder;
  std::filesystem::create_directory(folder / "real");
  std::filesystem::create_directory_symlink(folder / "real", folder / "linked");
  PartFile(folder / "linked/run").commit();
  EXPECT_TRUE(std::filesystem::exists(folder / "real/run"));
}

TEST(PartFile, IsNoPipe) {
  const TempFolder folder;
  ASSERT_EQ(mkfifo((folder / "run.part").c_str(), 0600), 0);
  EXPECT_THAT([&] { PartFile(folder / "run").commit(); },
              ThrowsTelling(FileProblem::unwritable, (folder / "run.part").string()));
}

TEST(PartFile, PutsNothingInThePlaceOfAPipeOrADevice) {
  const TempFolder folder;
  ASSERT_EQ(mkfifo((folder / "run").c_str(), 0600), 0);
  EXPECT_THAT([&] { PartFile(folder / "run").commit(); },
              ThrowsTelling(FileProblem::is_device_or_pipe, (folder / "run").string()));
  EXPECT_THAT([&] { PartFile("/dev/full").commit(); },
              ThrowsTelling(FileProblem::is_device_or_pipe, "/dev/full"));
  EXPECT_FALSE(std::filesystem::is_regular_file(folder / "run"));
}

TEST(PartFile, IsWrittenByOneProgramAtATime) {
  const TempFolder folder;
  PartFile first(folder / "run");
  first.write(kBytes);
  EXPECT_THAT([&] { PartFile(folder / "run").commit(); },
              ThrowsTelling(FileProblem::in_use, (folder / "run.part").string()));
  first.commit();
  EXPECT_EQ(load_file(folder / "run").size(), sizeof kBytes);
  EXPECT_NO_THROW(PartFile(folder / "run").commit()) << "and the next one may";
}

TEST(FolderLock, HoldsAFolderForOneProgramAndMakesIt) {
  const TempFolder folder;
  {
    const FolderLock lock(folder / "a/b");
    EXPECT_THAT([&] { FolderLock(folder / "a/b"); },
                ThrowsTelling(FileProblem::folder_in_use, (folder / "a/b").string()));
    EXPECT_NO_THROW(FolderLock(folder / "a"));
  }
  EXPECT_NO_THROW(FolderLock(folder / "a/b"));
}

TEST(LoadFile, SaysWhatTheSystemSaysOfALinkThatLeadsToItself) {
  const TempFolder folder;
  std::filesystem::create_symlink("loop", folder / "loop");
  const std::string loop = (folder / "loop").string(), said = std::generic_category().message(ELOOP);
  EXPECT_THAT([&] { load_file(loop); }, ThrowsTelling(FileProblem::unreadable, loop, said));
  EXPECT_THAT([&] { list_runs(loop); }, ThrowsTelling(RecordingProblem::folder_unreadable, loop, said));
}

TEST(LoadFile, RefusesWhatIsFarTooLargeForItsKindUnread) {
  const TempFolder folder;
  support::spill(folder / "x.toml", {});
  std::filesystem::resize_file(folder / "x.toml",
                               std::uintmax_t{300} << 20);  // a sparse file that takes no disk space
  EXPECT_THAT([&] { load_file(folder / "x.toml", kMaxSettingsBytes); },
              ThrowsTelling(FileProblem::too_large, (folder / "x.toml").string(), "314572800", "1048576"));
}

}  // namespace
}  // namespace astro::recording
