#include "host/formats/files/firmware_image.hpp"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <fstream>

#include "tests/support/base/bounded.hpp"
#include "tests/support/base/remarks.hpp"
#include "tests/support/base/temporary_folder.hpp"

namespace astro {
namespace {

using support::ThrowsTelling;

class HexFile : public testing::Test {
 protected:
  void holds(const std::string& text) const { std::ofstream(path(), std::ios::binary) << text; }
  std::filesystem::path path() const { return folder_.path() / "x.hex"; }

  test::TemporaryFolder folder_;
};

TEST_F(HexFile, FarLargerThanAnyImageIsRefusedUnread) {
  const std::string text(50'000'000, ':');
  holds(text);
  const support::Taken taken = support::measured([&] {
    EXPECT_THAT([&] { read_firmware_image(path()); },
                ThrowsTelling(ImageProblem::too_large, path().string()));
  });
  EXPECT_BOUNDED(taken, text.size());
}

TEST_F(HexFile, OfOneLongLineIsRefusedByItsLine) {
  const std::string text = ":" + std::string(15'000'000, '0');
  holds(text);
  const support::Taken taken = support::measured([&] {
    EXPECT_THAT([&] { read_firmware_image(path()); },
                ThrowsTelling(ImageProblem::not_intel_hex, path().string(), "1"));
  });
  EXPECT_BOUNDED(taken, text.size());
}

TEST_F(HexFile, ThatIsAPipeOrADeviceIsNotWaitedFor) {
  ASSERT_EQ(mkfifo(path().c_str(), 0600), 0);
  for (const std::filesystem::path& file : {path(), std::filesystem::path("/dev/zero")}) {
    const support::Taken taken = support::measured([&] {
      EXPECT_THAT([&] { read_firmware_image(file); }, ThrowsTelling(ImageProblem::unreadable, file.string()));
    });
    EXPECT_BOUNDED(taken, 0);
  }
}

}  // namespace
}  // namespace astro
