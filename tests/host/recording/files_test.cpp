#include "host/recording/files.hpp"

#include <gmock/gmock.h>

#include "tests/host/recording/support.hpp"

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
  EXPECT_THAT(complaint([&] { PartFile(folder.path()).commit(); }),
              HasSubstr("is a folder: name a file in it"));
  EXPECT_FALSE(std::filesystem::exists(folder.path().string() + ".part"));
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

}  // namespace
}  // namespace astro::recording
