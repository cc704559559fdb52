#include "host/emulator/core/register_names.hpp"

#include <fmt/format.h>

#include <unordered_map>

namespace astro::emulator {
namespace {

struct Instance {
  std::string_view type, name;
  std::uint32_t base;
};

struct Row {
  std::string_view type, name;
  std::uint32_t offset;
  int width;
};

#define TYPE(type)
#define FIELD(type, reg, name, lsb, width)
#define REGISTER(type, name, offset, width)
#define INSTANCE(type, name, address) Instance{#type, #name, address},
const std::vector<Instance> kInstances{
#include "hal/teensy40/registers/all.def"
};
#undef INSTANCE
#undef REGISTER
#define INSTANCE(type, name, address)
#define REGISTER(type, name, offset, width) Row{#type, #name, offset, width},
const std::vector<Row> kRows{
#include "hal/teensy40/registers/all.def"
};
#undef TYPE
#undef FIELD
#undef REGISTER
#undef INSTANCE

using Table = std::unordered_map<std::uint32_t, RegisterName>;

/// Rows that stand for a whole bank of registers.
void add_banks(Table& table) {
  for (std::uint32_t n = 0; n < 5; ++n)
    for (const auto& [name, base] : {std::pair{"ISER", 0xE000E100U}, std::pair{"ICER", 0xE000E180U},
                                     std::pair{"ISPR", 0xE000E200U}, std::pair{"ICPR", 0xE000E280U}})
      table[base + 4 * n] = {fmt::format("NVIC {}{}", name, n), 4};
  for (std::uint32_t n = 0; n < 40; ++n) table[0xE000E400 + 4 * n] = {fmt::format("NVIC IPR{}", n), 4};
}

Table make_table() {
  Table table;
  for (const RegisterRow& row : registers())
    table[row.address] = {fmt::format("{} {}", row.instance, row.name), row.bytes};
  add_banks(table);
  return table;
}

std::vector<RegisterRow> make_rows() {
  std::vector<RegisterRow> rows;
  for (const Instance& instance : kInstances)
    for (const Row& row : kRows)
      if (row.type == instance.type)
        rows.push_back({instance.name, row.name, instance.base + row.offset, row.width / 8});
  return rows;
}

}  // namespace

const std::vector<RegisterRow>& registers() {
  static const std::vector<RegisterRow> rows = make_rows();
  return rows;
}

const RegisterName* find_register(std::uint32_t address) {
  static const Table table = make_table();
  const auto found = table.find(address);
  return found == table.end() ? nullptr : &found->second;
}

std::string name_of(std::uint32_t address) {
  const RegisterName* known = find_register(address);
  return known != nullptr ? known->name : fmt::format("0x{:08X}", address);
}

}  // namespace astro::emulator
