#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace astro::target {

struct Instruction {
  std::uint32_t address;
  std::string mnemonic, operands;
};

/// A function of an image as binutils shows it.
struct Function {
  std::vector<Instruction> instructions;

  /// Bytes that its own code takes from the stack, all on one path: pushes and subtractions.
  std::uint32_t frame_bytes() const;
  /// Functions that it calls or goes on to.
  std::set<std::string> callees(const std::string& self) const;
  /// True if it calls through a register.
  bool calls_indirectly() const;
};

/// All functions of an ELF file by their linker names. Throws if there are none.
std::map<std::string, Function> disassemble(const std::string& elf);

/// Names of all symbols of an ELF file.
std::set<std::string> symbols(const std::string& elf);

/// What a command prints. Throws if it fails.
std::string output_of(const std::string& command);

}  // namespace astro::target
