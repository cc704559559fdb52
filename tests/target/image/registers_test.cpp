#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <tuple>
#include <vector>

namespace astro::target {
namespace {

struct Row {
  std::string kind, type, name, field;
  std::uint32_t a, b;  // instance: address; register: offset, width; field: lsb, width
};

const std::vector<Row>& rows() {
#define TYPE(type)
#define INSTANCE(type, name, address) {"instance", #type, #name, "", address, 0},
#define REGISTER(type, name, offset, width) {"register", #type, #name, "", offset, width},
#define FIELD(type, reg, name, lsb, width) {"field", #type, #reg, #name, lsb, width},
  static const std::vector<Row> all{
#include "hal/teensy40/registers/all.def"
  };
#undef TYPE
#undef INSTANCE
#undef REGISTER
#undef FIELD
  return all;
}

/// The rows that were collected and compared from several sources, by instance, register and field.
class RegisterRows : public testing::Test {
 protected:
  void SetUp() override {
    const std::filesystem::path path = ASTRO_SHARED_DATA "/../facts/teensy40/registers.csv";
    if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not on this machine";
    std::ifstream file(path);
    std::string line;
    std::getline(file, line);
    while (std::getline(file, line)) {
      std::vector<std::string> cells;
      std::istringstream fields(line);
      for (std::string cell; std::getline(fields, cell, ',');) cells.push_back(cell);
      const auto number = [](const std::string& text) {
        return static_cast<std::uint32_t>(std::stoul(text, nullptr, 0));
      };
      bases_[cells[0]] = number(cells[1]);
      if (cells[4].empty())
        registers_[{cells[0], cells[2]}] = {number(cells[3]), number(cells[6])};
      else
        fields_[{cells[0], cells[2], cells[4]}] = {number(cells[5]), number(cells[6])};
    }
    for (const Row& row : rows())
      if (row.kind == "instance") instances_[row.type].insert(row.name);
  }
  using Pair = std::pair<std::uint32_t, std::uint32_t>;
  std::map<std::string, std::uint32_t> bases_;
  std::map<std::pair<std::string, std::string>, Pair> registers_;
  std::map<std::tuple<std::string, std::string, std::string>, Pair> fields_;
  std::map<std::string, std::set<std::string>> instances_;
};

TEST_F(RegisterRows, AgreeWithTheCollectedOnesForEveryInstance) {
  int compared = 0;
  for (const Row& row : rows()) {
    if (row.kind == "instance") {
      ASSERT_TRUE(bases_.contains(row.name)) << row.name;
      EXPECT_EQ(row.a, bases_[row.name]) << row.name;
      ++compared;
      continue;
    }
    for (const std::string& instance : instances_[row.type]) {
      if (row.kind == "register") {
        const auto found = registers_.find({instance, row.name});
        ASSERT_NE(found, registers_.end()) << instance << " " << row.name;
        EXPECT_EQ(Pair(row.a, row.b), found->second) << instance << " " << row.name;
      } else {
        const auto found = fields_.find({instance, row.name, row.field});
        ASSERT_NE(found, fields_.end()) << instance << " " << row.name << " " << row.field;
        EXPECT_EQ(Pair(row.a, row.b), found->second) << instance << " " << row.name << " " << row.field;
      }
      ++compared;
    }
  }
  std::cout << "  " << compared << " addresses, offsets, widths and fields compared\n";
  EXPECT_GT(compared, 500);
}

}  // namespace
}  // namespace astro::target
