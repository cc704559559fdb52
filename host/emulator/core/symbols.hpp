#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

namespace astro::emulator {

/// Names of functions and variables of an image, from its .elf file. A default-constructed object has none.
class Symbols {
 public:
  Symbols() = default;
  /// Reads the symbol table of a 32-bit little-endian ELF file. Throws astro::Error if it is none.
  explicit Symbols(const std::filesystem::path& elf);

  /// "Clock::now_us()+0x12", or "" if nothing with a name begins at or before the address.
  std::string name_at(std::uint32_t address) const;

 private:
  struct Symbol {
    std::string name;
    std::uint32_t bytes;
  };
  void add(const std::string& linker_name, std::uint32_t address, std::uint32_t bytes);

  std::map<std::uint32_t, Symbol> by_address_;
};

}  // namespace astro::emulator
