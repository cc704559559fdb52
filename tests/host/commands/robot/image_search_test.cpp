#include "host/commands/robot/image_search.hpp"

#include <gmock/gmock.h>

#include <fstream>

#include "host/base/error.hpp"
#include "tests/support/base/temporary_folder.hpp"

// Which firmware image is taken if nobody names one.
namespace astro::commands {
namespace {

namespace fs = std::filesystem;

class ImageSearch : public testing::Test {
 protected:
  fs::path put(const fs::path& image) {
    fs::create_directories((folder_.path() / image).parent_path());
    std::ofstream(folder_.path() / image) << "image\n";
    return folder_.path() / image;
  }
  fs::path found(const char* board) {
    return find_image(board, folder_.path() / "build", folder_.path() / "share");
  }

  test::TemporaryFolder folder_;
};

TEST_F(ImageSearch, TakesTheInstalledImageOfTheRobotsBoard) {
  const fs::path teensy = put("share/astrolabe-teensy40.hex"), pico = put("share/astrolabe-rp2040.uf2");
  EXPECT_EQ(found("teensy40"), teensy);
  EXPECT_EQ(found("rp2040"), pico);
}

TEST_F(ImageSearch, PrefersWhatWasBuiltHere) {
  put("share/astrolabe-teensy40.hex");
  const fs::path built = put("build/teensy40/bin/astrolabe-teensy40.hex");
  EXPECT_EQ(found("teensy40"), built);
}

TEST_F(ImageSearch, NamesBothPlacesIfThereIsNone) {
  put("share/astrolabe-rp2040.uf2");
  try {
    found("teensy40");
    ADD_FAILURE() << "an image for another board was taken";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::AllOf(testing::HasSubstr("build/teensy40/bin/astrolabe-teensy40.hex"),
                                             testing::HasSubstr("share/astrolabe-teensy40.hex")));
  }
}

TEST_F(ImageSearch, SaysThatASimulatedRobotTakesNone) {
  try {
    found("sim");
    ADD_FAILURE() << "a simulated robot got an image";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(),
                 "the robot runs on a 'sim', for which there is no firmware to load: it loads into a Teensy "
                 "4.0 and a Pico");
  }
}

}  // namespace
}  // namespace astro::commands
