#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace astro::emulator {

/// A register of the chip as listed in hal/teensy40/registers.
struct RegisterRow {
  std::string_view instance, name;  // "PIT", "MCR"
  std::uint32_t address;
  int bytes;  // width of an access
};

/// All registers, separately for each instance.
const std::vector<RegisterRow>& registers();

struct RegisterName {
  std::string name;  // "PIT MCR"
  int bytes;         // width of an access
};

/// The row of hal/teensy40/registers for an address; nullptr if the project does not know a register there.
const RegisterName* find_register(std::uint32_t address);

/// The name of the register, or the address in hexadecimal.
std::string name_of(std::uint32_t address);

}  // namespace astro::emulator
