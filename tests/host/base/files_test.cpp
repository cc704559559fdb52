#include "host/base/files.hpp"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <fstream>

#include "host/base/folder_lock.hpp"
#include "host/recording/run_folder.hpp"
#include "tests/host/recording/support.hpp"
#include "tests/support/base/bounded.hpp"
#include "tests/support/base/remarks.hpp"

namespace astro::recording {
namespace {

using support::complaint;
using support::TempFolder;
using ::testing::HasSubstr;

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
  EXPECT_THAT(astro::support::told_by([&] { PartFile(folder.path()).commit(); }),
              astro::support::Tells(HasSubstr("is a folder"), Help::name_file_in_it));
  EXPECT_FALSE(std::filesystem::exists(folder.path().string() + ".part"));
}

TEST(RequireOwnKind, LetsOnlyFilesWithTheMarkBeReplacedAndEmptyOnes) {
  const TempFolder folder;
  const auto holds = [&](const std::string& text) {
    std::ofstream(folder / "out") << text;
    return complaint([&] { require_own_kind(folder / "out", "# ours", "report"); });
  };
  EXPECT_EQ(complaint([&] { require_own_kind(folder / "none", "# ours", "report"); }), "");
  EXPECT_EQ(holds(""), "");
  EXPECT_EQ(holds("title\n# ours\n"), "");
  EXPECT_THAT(holds("t_s,left,right\n"), HasSubstr("exists and is no report of this program"));
}

TEST(RequireNoInput, KnowsAnInputUnderAnotherName) {
  const TempFolder folder;
  std::ofstream(folder / "in") << "1";
  std::filesystem::create_symlink(folder / "in", folder / "link");
  EXPECT_THAT(complaint([&] {
                require_no_input(folder / "link", {folder / "other", folder / "in"});
              }),
              HasSubstr("is read, and would be overwritten"));
  EXPECT_EQ(complaint([&] { require_no_input(folder / "new", {folder / "in", {}}); }), "");
}

TEST(LoadText, RefusesASparseFileOfAGigabyteAtItsFirstHole) {
  const TempFolder folder;
  std::ofstream(folder / "sparse.csv") << "ex_mm,ey_mm\n1,2\n";
  std::filesystem::resize_file(folder / "sparse.csv", std::uintmax_t{1} << 30);
  const auto taken = astro::support::measured([&] { load_text(folder / "sparse.csv"); });
  EXPECT_BOUNDED(taken, 0);
  EXPECT_THAT(taken.complaint, HasSubstr("sparse.csv is not plain text: byte 17 is zero"));
}

TEST(LoadText, RefusesALineThatIsLongerThanAnyTableHas) {
  const TempFolder folder;
  std::ofstream(folder / "long.csv") << "ex_mm\r" << std::string(200 << 20, '1');
  const auto taken = astro::support::measured([&] { load_text(folder / "long.csv"); });
  EXPECT_TRUE(taken.ended);
  if (astro::support::kMeasuresMemory) {
    EXPECT_LE(taken.peak_bytes, std::size_t{16} << 20);
  }
  EXPECT_THAT(taken.complaint,
              HasSubstr("long.csv is no table: from byte 7 on, a line has more than 1048576"));
}

TEST(LoadText, IsTheWholeFileHoweverManyBlocksItTakes) {
  const TempFolder folder;
  std::string text;
  while (text.size() < (3U << 20)) text += std::to_string(text.size()) + ",2,3\r\n";
  std::ofstream(folder / "table.csv", std::ios::binary) << text;
  EXPECT_EQ(as_text(load_text(folder / "table.csv")), text);
  EXPECT_EQ(as_text(load_file(folder / "table.csv")), text);
  EXPECT_THAT(astro::support::told_by([&] { load_file(folder / "table.csv", kMaxSettingsBytes); }),
              astro::support::Tells(HasSubstr("no file of its kind has more than"), Help::name_right_file));
}

TEST(PartFile, ReplacesNoRecording) {
  const TempFolder folder;
  constexpr std::uint8_t kRecording[] = {0x89, 'M', 'C', 'A', 'P', '0', '\r', '\n'};
  for (const char* name : {"run.mcap", "run.html"}) {
    PartFile first(folder / name);
    first.write(kRecording);
    first.commit();
    EXPECT_THAT(complaint([&] { PartFile(folder / name).commit(); }),
                HasSubstr("is a recording, and nothing replaces one"));
    EXPECT_EQ(std::filesystem::file_size(folder / name), sizeof kRecording);
  }
}

TEST(PartFile, NeedsNoFolderInItsName) {
  const TempFolder folder;
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(folder.path());
  EXPECT_EQ(complaint([&] { PartFile("alone").commit(); }), "");
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
  EXPECT_THAT(complaint([&] { PartFile(folder / "run").commit(); }), HasSubstr("run.part is a link"));
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
  EXPECT_NE(complaint([&] { PartFile(folder / "run").commit(); }), "");
}

TEST(PartFile, PutsNothingInThePlaceOfAPipeOrADevice) {
  const TempFolder folder;
  ASSERT_EQ(mkfifo((folder / "run").c_str(), 0600), 0);
  EXPECT_THAT(complaint([&] { PartFile(folder / "run").commit(); }), HasSubstr("is a device or a pipe"));
  EXPECT_THAT(complaint([&] { PartFile("/dev/full").commit(); }), HasSubstr("is a device or a pipe"));
  EXPECT_FALSE(std::filesystem::is_regular_file(folder / "run"));
}

TEST(PartFile, IsWrittenByOneProgramAtATime) {
  const TempFolder folder;
  PartFile first(folder / "run");
  first.write(kBytes);
  EXPECT_THAT(complaint([&] { PartFile(folder / "run").commit(); }),
              HasSubstr("run.part is being written by another program"));
  first.commit();
  EXPECT_EQ(load_file(folder / "run").size(), sizeof kBytes);
  EXPECT_EQ(complaint([&] { PartFile(folder / "run").commit(); }), "") << "and the next one may";
}

TEST(FolderLock, HoldsAFolderForOneProgramAndMakesIt) {
  const TempFolder folder;
  {
    const FolderLock lock(folder / "a/b");
    EXPECT_THAT(complaint([&] { FolderLock(folder / "a/b"); }), HasSubstr("another program records into"));
    EXPECT_EQ(complaint([&] { FolderLock(folder / "a"); }), "");
  }
  EXPECT_EQ(complaint([&] { FolderLock(folder / "a/b"); }), "");
}

TEST(LoadFile, SaysWhatTheSystemSaysOfALinkThatLeadsToItself) {
  const TempFolder folder;
  std::filesystem::create_symlink("loop", folder / "loop");
  EXPECT_THAT(complaint([&] { load_file(folder / "loop"); }), HasSubstr("Too many levels of symbolic links"));
  EXPECT_THAT(complaint([&] { list_runs(folder / "loop"); }), HasSubstr("Too many levels of symbolic links"));
}

TEST(LoadFile, RefusesWhatIsFarTooLargeForItsKindUnread) {
  const TempFolder folder;
  support::spill(folder / "x.toml", {});
  std::filesystem::resize_file(folder / "x.toml",
                               std::uintmax_t{300} << 20);  // a sparse file that takes no disk space
  EXPECT_THAT(complaint([&] { load_file(folder / "x.toml", kMaxSettingsBytes); }),
              HasSubstr("x.toml has 314572800 bytes, and no file of its kind has more than 1048576"));
}

}  // namespace
}  // namespace astro::recording
