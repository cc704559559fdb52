#include "host/live/dashboard/session_files.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <filesystem>
#include <fstream>

#include "host/base/error.hpp"
#include "host/live/dashboard/static_files.hpp"
#include "tests/support/base/temporary_folder.hpp"

namespace astro::dashboard {
namespace {

namespace fs = std::filesystem;

void write(const fs::path& path, const std::string& text) {
  fs::create_directories(path.parent_path());
  std::ofstream(path) << text;
}

TEST(SessionFiles, AreOfThisUserAloneAndGoWithTheSession) {
  fs::path folder;
  {
    const SessionFiles files;
    folder = files.folder();
    write(folder / "a.csv", "1,2");
    EXPECT_EQ(fs::status(folder).permissions(), fs::perms::owner_all);
  }
  EXPECT_FALSE(fs::exists(folder));
}

TEST(SessionFiles, HaveNamesWithoutFolders) {
  const SessionFiles files;
  EXPECT_EQ(files.place_of("a b.csv"), files.folder() / "a b.csv");
  for (const std::string& name :
       {std::string(), std::string(".."), std::string("../x"), std::string("/etc/passwd"), std::string("a/b"),
        std::string(".link.html"), std::string(300, 'a'), std::string("a\0b", 3)})
    EXPECT_FALSE(files.place_of(name)) << name;
}

TEST(SessionFiles, AreFoundBelowTheirFolderAlone) {
  const SessionFiles files;
  write(files.folder() / "try-1/report.html", "report");
  EXPECT_TRUE(files.find("try-1/report.html"));
  EXPECT_TRUE(files.find("try-1/../try-1/report.html"));
  fs::create_symlink("/etc/passwd", files.folder() / "link");
  fs::create_directory_symlink("/etc", files.folder() / "folder");
  for (const char* path : {"", ".", "try-1", "nothing", "..", "../", "/etc/passwd", "try-1/../../etc/passwd",
                           "link", "folder/passwd"})
    EXPECT_FALSE(files.find(path)) << path;
}

TEST(SessionFiles, CountWhatTheyTake) {
  const SessionFiles files;
  const std::uint64_t before = files.room();
  write(files.folder() / "a", std::string(1000, 'x'));
  write(files.folder() / "b/c", std::string(500, 'x'));
  EXPECT_EQ(before - files.room(), 1500U);
}

TEST(SessionFiles, AreKeptUnderANameThatReplacesNothing) {
  const test::TemporaryFolder to;
  SessionFiles files;
  write(files.folder() / "a.mcap", "drive");
  for (const char* name : {"a.mcap", "a-2.mcap", "a-3.mcap"}) {
    const fs::path kept = files.keep(files.folder() / "a.mcap", to.path() / "drives");
    EXPECT_EQ(kept.filename(), name);
    EXPECT_EQ(fs::file_size(kept), 5U);
  }
}

TEST(SessionFiles, StayWhereTheyAreIfTheyCannotBeKept) {
  fs::path folder;
  {
    SessionFiles files;
    folder = files.folder();
    write(folder / "a.mcap", "drive");
    EXPECT_THROW(files.keep(folder / "a.mcap", folder / "a.mcap/below"), Error);
  }
  EXPECT_EQ(fs::file_size(folder / "a.mcap"), 5U);
  fs::remove_all(folder);
}

// As on a full disk: no file of this process grows beyond a few kilobytes.
TEST(SessionFiles, LeaveNoPartOfACopyThatDoesNotFit) {
  const test::TemporaryFolder to;
  fs::path folder;
  {
    SessionFiles files;
    folder = files.folder();
    write(folder / "a.mcap", std::string(100'000, 'd'));
    rlimit before{};
    ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit small{4096, before.rlim_max};
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
    EXPECT_THROW(files.keep(folder / "a.mcap", to.path()), Error);
    ::setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, handler);
  }
  EXPECT_FALSE(fs::exists(to.path() / "a.mcap"));
  EXPECT_EQ(fs::file_size(folder / "a.mcap"), 100'000U);
  fs::remove_all(folder);
}

TEST(PercentDecoded, IsThatOfALinkOrNothing) {
  EXPECT_EQ(percent_decoded("a%20b%2fc%C3%A4"), "a b/c\xC3\xA4");
  for (const char* bad : {"%", "%4", "%4g", "a%"}) EXPECT_FALSE(percent_decoded(bad)) << bad;
}

TEST(StaticFiles, AreThoseOfThePageAlone) {
  const test::TemporaryFolder folder;
  write(folder.path() / "page/index.html", "<p>");
  write(folder.path() / "page/assets/a.js", "1");
  write(folder.path() / "secret", "s");
  const StaticFiles files(folder.path() / "page");
  EXPECT_EQ(files.find("/").status, 200);
  EXPECT_EQ(files.find("/assets/a.js").fields.front().second, "text/javascript");
  for (const char* path : {"/secret", "/../secret", "/assets/../../secret", "/assets", "", "index.html",
                           "/%2e%2e/secret", "//etc/passwd", "/assets/a.js\n"})
    EXPECT_EQ(files.find(path).status, 404) << path;
}

}  // namespace
}  // namespace astro::dashboard
