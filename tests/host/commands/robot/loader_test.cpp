#include "host/commands/robot/loader.hpp"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

#include "tests/support/base/bounded.hpp"
#include "tests/support/base/temporary_folder.hpp"

// A program that is no loader: its last line is reported, whatever it printed before.
namespace astro::commands {
namespace {

namespace fs = std::filesystem;

support::Taken running(const std::string& script) {
  const test::TemporaryFolder folder;
  const fs::path loader = folder.path() / "loader";
  std::ofstream(loader) << "#!/bin/sh\n" << script << '\n';
  fs::permissions(loader, fs::perms::owner_all);
  return support::measured([&] { run_loader(loader, "x.hex"); });
}

TEST(Loader, ThatSaysThreeHundredMegabytesIsHeardToItsEnd) {
  const support::Taken taken = running("head -c 300000000 /dev/zero; echo; echo 'no Teensy found'; exit 1");
  EXPECT_BOUNDED(taken, 0);
  EXPECT_EQ(taken.complaint,
            "the loader failed: no Teensy found (press the robot's button and flash again with --button)");
}

TEST(Loader, ThatSaysOneLineOfThreeHundredMegabytesIsNotKept) {
  const support::Taken taken = running("head -c 300000000 /dev/zero; exit 1");
  EXPECT_BOUNDED(taken, 0);
  EXPECT_THAT(taken.complaint, testing::StartsWith("the loader failed: "));
}

}  // namespace
}  // namespace astro::commands
