#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <vector>

#include "tests/support/base/places.hpp"
#include "tests/target/image/hex_file.hpp"

namespace astro::target {
namespace {

using Words = std::map<std::uint32_t, std::uint32_t>;

constexpr std::uint32_t kFlashStart = 0x6000'0000, kEntry = 0x6000'1004, kLength = 0x6000'1024;
constexpr std::uint32_t kConfigurationBytes = 512;

/// What the boot ROM and the Teensy's boot loaders must find, as on every Teensy 4.0.
const Words kGolden{{0x60000000, 0x42464346}, {0x60000004, 0x56010000}, {0x6000000C, 0x00020101},
                    {0x60000044, 0x01060401}, {0x60000050, 0x00200000}, {0x60000080, 0x0A1804EB},
                    {0x60000084, 0x32041EFF}, {0x60000088, 0x00002601}, {0x600001C0, 0x00000100},
                    {0x600001C4, 0x00001000}, {0x600001C8, 0x00000001}, {0x600001D0, 0x00010000},
                    {0x60001000, 0x432000D1}, {0x60001008, 0x00000000}, {0x6000100C, 0x00000000},
                    {0x60001010, 0x60001020}, {0x60001014, 0x60001000}, {0x60001018, 0x00000000},
                    {0x6000101C, 0x00000000}, {0x60001020, 0x60000000}, {0x60001028, 0x00000000}};

/// Addresses at which the image has another word, or one between the words of the configuration that is not
/// zero.
std::vector<std::uint32_t> differences(const Bytes& bytes, const Words& golden) {
  std::vector<std::uint32_t> found;
  for (const auto& [address, value] : golden)
    if (word(bytes, address) != value) found.push_back(address);
  for (std::uint32_t address = kFlashStart; address < kFlashStart + kConfigurationBytes; address += 4)
    if (!golden.contains(address) && word(bytes, address) != 0) found.push_back(address);
  return found;
}

bool states_its_length(const Bytes& bytes) {
  return word(bytes, kLength) == bytes.rbegin()->first + 1 - kFlashStart;
}

bool enters_a_thumb_function_in_the_flash(const Bytes& bytes) {
  const std::uint32_t entry = word(bytes, kEntry);
  return (entry & 1U) == 1 && bytes.contains(entry - 1);
}

class ImageHeader : public testing::TestWithParam<const char*> {
 protected:
  Bytes bytes_ = read_hex(image("hex", GetParam()));
};

TEST_P(ImageHeader, IsTheOneOfATeensy40) {
  EXPECT_THAT(differences(bytes_, kGolden), testing::IsEmpty());
  EXPECT_TRUE(enters_a_thumb_function_in_the_flash(bytes_));
  EXPECT_TRUE(states_its_length(bytes_));
}

TEST_P(ImageHeader, LeavesTheParametersAndTheRestoreProgramAlone) {
  EXPECT_EQ(bytes_.begin()->first, kFlashStart);
  EXPECT_LT(bytes_.rbegin()->first, 0x601F'0000U);
}

TEST_P(ImageHeader, IsNotTakenForRightWithAnyBitOfItChanged) {
  for (const auto& [address, value] : kGolden)
    for (std::uint32_t bit = 0; bit < 32; ++bit) {
      bytes_[address + bit / 8] ^= static_cast<std::uint8_t>(1U << bit % 8);
      ASSERT_THAT(differences(bytes_, kGolden), testing::ElementsAre(address));
      bytes_[address + bit / 8] ^= static_cast<std::uint8_t>(1U << bit % 8);
    }
}

TEST_P(ImageHeader, IsNotTakenForRightWithAByteMoreOrWithoutItsEntry) {
  Bytes longer = bytes_;
  longer[bytes_.rbegin()->first + 1] = 0;
  EXPECT_FALSE(states_its_length(longer));
  Bytes not_thumb = bytes_;
  not_thumb[kEntry] ^= 1;
  EXPECT_FALSE(enters_a_thumb_function_in_the_flash(not_thumb));
}

INSTANTIATE_TEST_SUITE_P(Of, ImageHeader, testing::Values("astrolabe-teensy40", "blink"),
                         [](const auto& of) { return std::string(of.param).substr(0, 5); });

TEST(GoldenWords, AreTheIndependentlyCollectedOnes) {
  const std::filesystem::path path = support::shared_data() / "../facts/teensy40/fcb_ivt_golden.csv";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not on this machine";
  std::ifstream file(path);
  Words collected;
  for (std::string line; std::getline(file, line);) {
    const auto comma = line.find(',');
    const std::string value = line.substr(comma + 1);
    if (value.starts_with("0x"))  // the entry and the length are each image's own
      collected[static_cast<std::uint32_t>(std::stoul(line, nullptr, 16))] =
          static_cast<std::uint32_t>(std::stoul(value, nullptr, 16));
  }
  EXPECT_EQ(collected, kGolden);
}

}  // namespace
}  // namespace astro::target
