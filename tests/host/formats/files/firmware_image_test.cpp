#include "host/formats/files/firmware_image.hpp"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <fstream>

#include "host/base/error.hpp"
#include "tests/support/base/bounded.hpp"
#include "tests/support/base/temporary_folder.hpp"

namespace astro {
namespace {

using testing::HasSubstr;

class HexFile : public testing::Test {
 protected:
  support::Taken reading(const std::string& text) const {
    std::ofstream(path(), std::ios::binary) << text;
    return support::measured([&] { read_firmware_image(path()); });
  }
  std::filesystem::path path() const { return folder_.path() / "x.hex"; }

  test::TemporaryFolder folder_;
};

TEST_F(HexFile, FarLargerThanAnyImageIsRefusedUnread) {
  const std::string text(50'000'000, ':');
  const support::Taken taken = reading(text);
  EXPECT_BOUNDED(taken, text.size());
  EXPECT_THAT(taken.complaint, HasSubstr("x.hex' is larger than any image for a Teensy 4.0"));
}

TEST_F(HexFile, OfOneLongLineIsRefusedByItsLine) {
  const std::string text = ":" + std::string(15'000'000, '0');
  const support::Taken taken = reading(text);
  EXPECT_BOUNDED(taken, text.size());
  EXPECT_THAT(taken.complaint, HasSubstr("x.hex:1 is no Intel HEX record"));
}

TEST_F(HexFile, ThatIsAPipeOrADeviceIsNotWaitedFor) {
  ASSERT_EQ(mkfifo(path().c_str(), 0600), 0);
  for (const std::filesystem::path& file : {path(), std::filesystem::path("/dev/zero")}) {
    const support::Taken taken = support::measured([&] { read_firmware_image(file); });
    EXPECT_BOUNDED(taken, 0);
    EXPECT_THAT(taken.complaint, HasSubstr("cannot read"));
  }
}

}  // namespace
}  // namespace astro
