#include "host/commands/robot/pico_drive.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "host/base/error.hpp"
#include "tests/support/base/temporary_folder.hpp"

namespace astro::commands {
namespace {

namespace fs = std::filesystem;

class PicoDrive : public testing::Test {
 protected:
  PicoDrive() {
    for (const char* name : {"one", "other"}) {
      fs::create_directory(folder_.path() / name);
      std::ofstream(folder_.path() / name / "INFO_UF2.TXT") << "Board-ID: RPI-RP2\n";
      std::ofstream(device(name)) << "";
    }
  }
  std::string device(const std::string& name) const { return (folder_.path() / (name + ".dev")).string(); }
  std::string mount(const std::string& name, const std::string& type = "vfat") const {
    return device(name) + ' ' + (folder_.path() / name).string() + ' ' + type + " rw 0 0\n";
  }

  test::TemporaryFolder folder_;
};

TEST_F(PicoDrive, IsTheOneThatHoldsTheDescriptionOfTheLoader) {
  EXPECT_EQ(pico_drive_among("proc /proc proc rw 0 0\n" + mount("one") + mount("other", "ext4")),
            folder_.path() / "one");
  EXPECT_EQ(pico_drive_among(mount("one") + mount("one")), folder_.path() / "one");
  EXPECT_EQ(pico_drive_among(""), std::nullopt);
}

TEST_F(PicoDrive, IsNoneIfItsDeviceIsGone) {
  fs::remove(device("one"));
  EXPECT_EQ(pico_drive_among(mount("one")), std::nullopt);
  EXPECT_EQ(pico_drive_among(mount("one") + mount("other")), folder_.path() / "other");
}

TEST_F(PicoDrive, IsNotGuessedAmongTwo) {
  EXPECT_THROW(pico_drive_among(mount("one") + mount("other")), Error);
}

}  // namespace
}  // namespace astro::commands
