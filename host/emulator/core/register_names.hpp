#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace astro::emulator {

/// A register of the chip as hal/teensy40/registers has it.
struct RegisterRow {
  std::string_view instance, name;  // "PIT", "MCR"
  std::uint32_t address;
  int bytes;  // width of an access
};

/// All of them, each instance's own.
const std::vector<RegisterRow>& registers();

struct RegisterName {
  std::string name;  // "PIT MCR"
  int bytes;         // width of an access
};

/// The row of hal/teensy40/registers for an address; nullptr if the project does not know a register there.
const RegisterName* find_register(std::uint32_t address);

/// Its name, or the address in digits.
std::string name_of(std::uint32_t address);

}  // namespace astro::emulator
