#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace astro::target {

struct Instruction {
  std::uint32_t address;
  std::string mnemonic, operands;

  /// Bytes that it takes from the stack; nothing if only running shows how many.
  std::optional<std::uint32_t> stack_bytes() const;
  /// The function that it branches to, or into whose middle; empty if it does not, or does so through a
  /// pointer.
  std::string branch_target() const;
  bool branches_into_the_middle() const;
  /// It writes down where to come back to.
  bool calls() const;
  /// It goes where a register or a word of memory says, and that is not back to its caller.
  bool goes_through_pointer() const;
  /// What follows it in memory is not executed after it; or it is a call, which may be for good.
  bool ends_a_path() const;
  /// It does nothing but bring the next function to its alignment. Zeros read as `movs r0, r0`.
  bool fills() const {
    return mnemonic.starts_with("nop") || (mnemonic == "movs" && operands.starts_with("r0, r0"));
  }
};

struct Function {
  std::vector<Instruction> instructions;
};

/// The code of an ELF file as binutils show it, by linker names.
struct Program {
  std::map<std::string, Function> functions;
  /// Functions, and sections of code, whose address is written down somewhere: only these can be reached
  /// through a pointer. Needs a file that was linked with --emit-relocs.
  std::set<std::string> addresses_taken;
};

/// Throws if there is no code in it.
Program read_program(const std::string& elf);

}  // namespace astro::target
