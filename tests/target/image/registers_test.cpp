#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <span>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace astro::target {
namespace {

/// By "ENC1", "ENC1 CTRL" or "ENC1 CTRL SWIP": an address, or an offset and a width, or a lowest bit and a
/// width.
using Rows = std::map<std::string, std::pair<std::uint32_t, std::uint32_t>>;

// Plain constants: a thousand strings made one by one take half a minute to compile.
struct Row {
  std::string_view kind, type, name;  // a register's name; a register's and its field's
  std::uint32_t place, width;
};

/// As the drivers have them, by type of peripheral.
std::span<const Row> written_rows() {
#define TYPE(type)
#define INSTANCE(type, name, address) {"instance", #type, #name, address, 0},
#define REGISTER(type, name, offset, width) {"register", #type, #name, offset, width},
#define FIELD(type, reg, name, lsb, width) {"field", #type, #reg " " #name, lsb, width},
  static constexpr Row all[] = {
#include "hal/teensy40/registers/all.def"
#include "tests/support/base/places.hpp"
  };
#undef TYPE
#undef INSTANCE
#undef REGISTER
#undef FIELD
  return all;
}

/// The same for every instance of the type.
Rows spread_over_instances(std::span<const Row> rows) {
  Rows spread;
  for (const Row& instance : rows) {
    if (instance.kind != "instance") continue;
    const std::string name(instance.name);
    spread[name] = {instance.place, 0};
    for (const Row& row : rows)
      if (row.kind != "instance" && row.type == instance.type)
        spread[name + " " + std::string(row.name)] = {row.place, row.width};
  }
  return spread;
}

/// "peripheral,base,register,offset,bitfield,lsb,width,source"
Rows collected_rows(std::istream& file) {
  const auto number = [](const std::string& text) {
    return static_cast<std::uint32_t>(std::stoul(text, nullptr, 0));
  };
  Rows rows;
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::vector<std::string> cells;
    std::istringstream fields(line);
    for (std::string cell; std::getline(fields, cell, ',');) cells.push_back(cell);
    rows[cells.at(0)] = {number(cells.at(1)), 0};
    const std::string name = cells[0] + " " + cells.at(2);
    if (cells.at(4).empty())
      rows[name] = {number(cells.at(3)), number(cells.at(6))};
    else
      rows[name + " " + cells[4]] = {number(cells.at(5)), number(cells.at(6))};
  }
  return rows;
}

/// What is written here and not collected, or collected otherwise.
std::vector<std::string> differences(const Rows& written, const Rows& collected) {
  std::vector<std::string> found;
  for (const auto& [name, numbers] : written)
    if (const auto same = collected.find(name); same == collected.end() || same->second != numbers)
      found.push_back(name);
  return found;
}

/// In rows that were not collected. They were compared with the core library of the Teensy's maker, imxrt.h.
constexpr std::string_view kComparedByHand = "LPI2C1";

TEST(Registers, AgreeWithTheIndependentlyCollectedOnes) {
  const std::filesystem::path path = support::shared_data() / "../facts/teensy40/registers.csv";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not on this machine";
  std::ifstream file(path);
  const Rows written = spread_over_instances(written_rows());
  std::cout << "  " << written.size() << " addresses, offsets, widths and fields\n";
  EXPECT_GT(written.size(), 500U);
  Rows collected = collected_rows(file);
  for (const auto& row : written)
    if (row.first.find(kComparedByHand) != std::string::npos) collected.insert(row);
  EXPECT_THAT(differences(written, collected), testing::IsEmpty());
}

TEST(Registers, ThatDifferInAnyNumberOrAreUnknownAreFound) {
  std::istringstream collected(
      "peripheral,base,register,offset,bitfield,lsb,width,source\n"
      "ENC1,0x403C8000,CTRL,0x000,,0,16,nxp\nENC1,0x403C8000,CTRL,0x000,REV,10,1,nxp\n"
      "ENC2,0x403CC000,CTRL,0x000,,0,16,nxp\nENC2,0x403CC000,CTRL,0x000,REV,11,1,nxp\n");
  const std::vector<Row> rows{{"instance", "enc", "ENC1", 0x403C8000, 0},
                              {"instance", "enc", "ENC2", 0x403CC004, 0},
                              {"register", "enc", "CTRL", 0, 16},
                              {"field", "enc", "CTRL REV", 10, 1},
                              {"register", "enc", "FILT", 2, 16}};
  EXPECT_THAT(differences(spread_over_instances(rows), collected_rows(collected)),
              testing::UnorderedElementsAre("ENC2", "ENC2 CTRL REV", "ENC1 FILT", "ENC2 FILT"));
}

}  // namespace
}  // namespace astro::target
