#pragma once

#include <cstdint>

/// Functions of the boot ROM, by their two letters.
///
/// Source  RP2040 data sheet, 2.8.3: the table and the function that searches it stand at fixed addresses.
namespace astro::rp2040::boot_rom {

/// The address of a function, or 0 if the ROM has none of this name.
inline std::uintptr_t find(char first, char second) {
  const auto halfword = [](std::uintptr_t at) {
    return std::uintptr_t{*reinterpret_cast<const volatile std::uint16_t*>(at)};
  };
  using Search = void* (*)(const void* table, std::uint32_t code);
  const auto search = reinterpret_cast<Search>(halfword(0x18));
  const auto code = static_cast<std::uint32_t>(static_cast<std::uint8_t>(first)) |
                    static_cast<std::uint32_t>(static_cast<std::uint8_t>(second)) << 8;
  return reinterpret_cast<std::uintptr_t>(search(reinterpret_cast<const void*>(halfword(0x14)), code));
}

/// The function of that name as `Function`, a type of pointer.
template <class Function>
Function get(char first, char second) {
  return reinterpret_cast<Function>(find(first, second));
}

}  // namespace astro::rp2040::boot_rom
