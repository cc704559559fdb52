#include <gtest/gtest.h>

#include <iostream>
#include <sstream>

#include "tests/target/image/disassembly.hpp"
#include "tests/target/image/hex_file.hpp"

namespace astro::target {
namespace {

/// Size and address of every section that takes memory on the chip.
std::map<std::string, std::pair<std::uint32_t, std::uint32_t>> sections() {
  std::map<std::string, std::pair<std::uint32_t, std::uint32_t>> found;
  std::istringstream lines(output_of("arm-none-eabi-size -A -d '" + image("elf") + "'"));
  std::string line;
  while (std::getline(lines, line)) {
    std::istringstream words(line);
    std::string name;
    std::uint32_t size = 0, address = 0;
    if (words >> name >> size >> address && name.starts_with(".") && !name.starts_with(".debug") &&
        !name.starts_with(".ARM"))
      found[name] = {size, address};
  }
  return found;
}

TEST(Image, TakesAtMost64KilobytesOfFlash) {
  const auto bytes = read_hex(image("hex"));
  const std::uint32_t taken = bytes.rbegin()->first + 1 - 0x60000000;
  std::cout << "  flash " << taken << " bytes of 65536\n";
  EXPECT_LE(taken, 64U * 1024);
}

TEST(Image, TakesAtMost16KilobytesOfRamWithItsStack) {
  std::uint32_t taken = 0;
  for (const auto& [name, section] : sections())
    if (section.second >= 0x2000'0000 && section.second < 0x2100'0000)
      taken = std::max(taken, section.second + section.first - 0x2000'0000);
  std::cout << "  RAM " << taken << " bytes of 16384\n";
  EXPECT_GT(taken, 0U);
  EXPECT_LE(taken, 16U * 1024);
}

TEST(Image, HasItsStackAtTheBottomOfRam) {
  const auto found = sections();
  ASSERT_TRUE(found.contains(".stack"));
  EXPECT_EQ(found.at(".stack").second, 0x2000'0000U);
}

TEST(Image, KeepsTheFirst32BytesOfCodeMemoryEmpty) { EXPECT_GE(sections().at(".text").second, 32U); }

}  // namespace
}  // namespace astro::target
