#include <gtest/gtest.h>

#include <iostream>
#include <sstream>

#include "tests/target/image/binutils.hpp"
#include "tests/target/image/hex_file.hpp"

namespace astro::target {
namespace {

constexpr std::uint32_t kFlash = 0x6000'0000, kRam = 0x2000'0000, kRamEnd = 0x2100'0000;
constexpr std::uint32_t kFlashBudget = 96 * 1024, kRamBudget = 24 * 1024;

struct Section {
  std::uint32_t bytes, address;
};

/// As `size -A` prints them.
std::map<std::string, Section> sections(const std::string& text) {
  std::map<std::string, Section> found;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string name;
    Section section{};
    if (words >> name >> section.bytes >> section.address && name.starts_with(".")) found[name] = section;
  }
  return found;
}

std::map<std::string, Section> sections_of_image() {
  return sections(output_of("arm-none-eabi-size -A -d '" + image("elf") + "'"));
}

/// To the end of what lies highest, gaps and stack included.
std::uint32_t ram_taken(const std::map<std::string, Section>& all) {
  std::uint32_t end = kRam;
  for (const auto& [name, section] : all)
    if (section.address >= kRam && section.address < kRamEnd)
      end = std::max(end, section.address + section.bytes);
  return end - kRam;
}

TEST(Budget, AtMost96KilobytesOfFlash) {
  const std::uint32_t taken = read_hex(image("hex")).rbegin()->first + 1 - kFlash;
  std::cout << "  flash " << taken << " bytes of " << kFlashBudget << "\n";
  EXPECT_LE(taken, kFlashBudget);
}

TEST(Budget, AtMost24KilobytesOfRamWithTheStack) {
  const std::uint32_t taken = ram_taken(sections_of_image());
  std::cout << "  RAM " << taken << " bytes of " << kRamBudget << "\n";
  EXPECT_GT(taken, sections_of_image().at(".stack").bytes);
  EXPECT_LE(taken, kRamBudget);
}

TEST(Budget, CountsGapsAndEverythingAboveThem) {
  const auto all = sections(
      "file.elf  :\nsection  size  addr\n.text 70000 32\n.stack 3072 536870912\n"
      ".bss 100 536895488\n.debug_info 9999999 0\n");
  EXPECT_EQ(ram_taken(all), 536895488U - kRam + 100);
  EXPECT_GT(ram_taken(all), kRamBudget);
}

TEST(Memory, TheStackLiesAtTheBottomOfRam) { EXPECT_EQ(sections_of_image().at(".stack").address, kRam); }

TEST(Memory, TheFirst32BytesOfCodeMemoryStayEmpty) {
  EXPECT_GE(sections_of_image().at(".text").address, 32U);
}

}  // namespace
}  // namespace astro::target
