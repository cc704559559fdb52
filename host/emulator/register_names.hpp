#pragma once

#include <cstdint>
#include <string>

namespace astro::emulator {

struct RegisterName {
  std::string name;  // "PIT MCR"
  int bytes;         // width of an access
};

/// The row of hal/teensy40/registers for an address; nullptr if the project does not know a register there.
const RegisterName* find_register(std::uint32_t address);

/// Its name, or the address in digits.
std::string name_of(std::uint32_t address);

}  // namespace astro::emulator
