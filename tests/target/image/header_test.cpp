#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>

#include "tests/target/image/hex_file.hpp"

namespace astro::target {
namespace {

/// What the boot ROM and the Teensy's boot loaders must find, as on every Teensy 4.0.
const std::map<std::uint32_t, std::uint32_t> kGolden{
    {0x60000000, 0x42464346}, {0x60000004, 0x56010000}, {0x6000000C, 0x00020101}, {0x60000044, 0x01060401},
    {0x60000050, 0x00200000}, {0x60000080, 0x0A1804EB}, {0x60000084, 0x32041EFF}, {0x60000088, 0x00002601},
    {0x600001C0, 0x00000100}, {0x600001C4, 0x00001000}, {0x600001C8, 0x00000001}, {0x600001D0, 0x00010000},
    {0x60001000, 0x432000D1}, {0x60001008, 0x00000000}, {0x6000100C, 0x00000000}, {0x60001010, 0x60001020},
    {0x60001014, 0x60001000}, {0x60001018, 0x00000000}, {0x6000101C, 0x00000000}, {0x60001020, 0x60000000},
    {0x60001028, 0x00000000}};

class ImageHeader : public testing::Test {
 protected:
  const std::map<std::uint32_t, std::uint8_t> bytes_ = read_hex(image("hex"));
};

TEST_F(ImageHeader, IsTheOneOfATeensy40) {
  for (const auto& [address, value] : kGolden)
    EXPECT_EQ(word(bytes_, address), value) << std::hex << "at " << address;
}

TEST_F(ImageHeader, HasOnlyZerosBetweenTheWordsOfTheFlashConfiguration) {
  for (std::uint32_t address = 0x60000000; address < 0x60000200; address += 4)
    if (!kGolden.contains(address)) {
      EXPECT_EQ(word(bytes_, address), 0U) << std::hex << "at " << address;
    }
}

TEST_F(ImageHeader, AgreesWithTheIndependentlyCollectedWords) {
  const std::filesystem::path path = ASTRO_SHARED_DATA "/../facts/teensy40/fcb_ivt_golden.csv";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not on this machine";
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  int compared = 0;
  while (std::getline(file, line)) {
    std::istringstream fields(line);
    std::string address, value;
    std::getline(fields, address, ',');
    std::getline(fields, value, ',');
    if (!value.starts_with("0x")) continue;  // the entry and the length are this image's own
    EXPECT_EQ(word(bytes_, static_cast<std::uint32_t>(std::stoul(address, nullptr, 16))),
              std::stoul(value.substr(0, 10), nullptr, 16))
        << line;
    ++compared;
  }
  EXPECT_GE(compared, 20);
}

TEST_F(ImageHeader, EntersAThumbFunctionInTheFlash) {
  const std::uint32_t entry = word(bytes_, 0x60001004);
  EXPECT_EQ(entry & 1U, 1U);
  EXPECT_TRUE(bytes_.contains(entry - 1));
}

TEST_F(ImageHeader, StatesTheTrueLengthOfTheImage) {
  EXPECT_EQ(word(bytes_, 0x60001024), bytes_.rbegin()->first + 1 - 0x60000000);
}

TEST_F(ImageHeader, LeavesTheParametersAndTheRestoreProgramAlone) {
  EXPECT_EQ(bytes_.begin()->first, 0x60000000U);
  EXPECT_LT(bytes_.rbegin()->first, 0x601F0000U);
}

}  // namespace
}  // namespace astro::target
