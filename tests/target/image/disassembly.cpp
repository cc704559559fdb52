#include "tests/target/image/disassembly.hpp"

#include <array>
#include <cstdio>
#include <regex>
#include <sstream>
#include <stdexcept>

namespace astro::target {
namespace {

// "{r4, r5, r6, lr}" or "{r3, r7-r9, lr}"
std::uint32_t registers_in(const std::string& list) {
  static const std::regex range(R"(r(\d+)-r(\d+))");
  std::uint32_t count = 1;
  for (const char c : list) count += c == ',' ? 1 : 0;
  for (std::sregex_iterator it(list.begin(), list.end(), range), end; it != end; ++it)
    count += static_cast<std::uint32_t>(std::stoul((*it)[2]) - std::stoul((*it)[1]));
  return count;
}

std::string target_name(const std::string& operands) {
  const auto open = operands.rfind('<');
  return open == std::string::npos ? "" : operands.substr(open + 1, operands.rfind('>') - open - 1);
}

}  // namespace

std::string output_of(const std::string& command) {
  FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) throw std::runtime_error("cannot run " + command);
  std::string text;
  std::array<char, 65536> block{};
  while (const std::size_t count = fread(block.data(), 1, block.size(), pipe))
    text.append(block.data(), count);
  if (pclose(pipe) != 0) throw std::runtime_error("failed: " + command);
  return text;
}

std::map<std::string, Function> disassemble(const std::string& elf) {
  static const std::regex head(R"(^([0-9a-f]+) <(.+)>:$)");
  static const std::regex body(R"(^ *([0-9a-f]+):\t([^\t ]+)[\t ]*(.*)$)");
  std::map<std::string, Function> functions;
  std::istringstream lines(output_of("arm-none-eabi-objdump -d --no-show-raw-insn '" + elf + "'"));
  Function* current = nullptr;
  std::smatch match;
  for (std::string line; std::getline(lines, line);) {
    if (std::regex_match(line, match, head)) {
      current = &functions[match[2]];
    } else if (current != nullptr && std::regex_match(line, match, body)) {
      if (match[2].str().starts_with(".")) continue;  // a constant between functions
      current->instructions.push_back(
          {static_cast<std::uint32_t>(std::stoul(match[1], nullptr, 16)), match[2], match[3]});
    }
  }
  if (functions.empty()) throw std::runtime_error("no code in " + elf);
  return functions;
}

std::set<std::string> symbols(const std::string& elf) {
  std::set<std::string> names;
  std::istringstream lines(output_of("arm-none-eabi-nm '" + elf + "'"));
  // An address, which an undefined symbol has not, a kind, a name.
  for (std::string line; std::getline(lines, line);) names.insert(line.substr(line.rfind(' ') + 1));
  return names;
}

std::uint32_t Function::frame_bytes() const {
  static const std::regex push(R"(\{([^}]*)\})"), immediate(R"(#(\d+))");
  std::uint32_t bytes = 0;
  std::smatch match;
  for (const Instruction& i : instructions) {
    const bool pushes =
        i.mnemonic.starts_with("push") || (i.mnemonic.starts_with("stmdb") && i.operands.starts_with("sp!"));
    if (pushes && std::regex_search(i.operands, match, push)) bytes += 4 * registers_in(match[1]);
    const bool subtracts = i.mnemonic.starts_with("sub") && i.operands.starts_with("sp,");
    const bool stores_below = i.mnemonic.starts_with("str") &&
                              i.operands.find("[sp, #-") != std::string::npos && i.operands.ends_with("]!");
    if (subtracts && std::regex_search(i.operands, match, immediate))
      bytes += static_cast<std::uint32_t>(std::stoul(match[1]));
    if (stores_below) bytes += i.mnemonic.starts_with("strd") ? 8 : 4;
  }
  return bytes;
}

std::set<std::string> Function::callees(const std::string& self) const {
  std::set<std::string> names;
  for (const Instruction& i : instructions) {
    if (!i.mnemonic.starts_with("b") && !i.mnemonic.starts_with("cb")) continue;
    std::string name = target_name(i.operands);
    const bool inside = name.find('+') != std::string::npos;
    name = name.substr(0, name.find('+'));
    if (name.empty()) continue;
    // A call of itself is one; a jump within itself is none.
    if (name == self && (inside || !i.mnemonic.starts_with("bl"))) continue;
    names.insert(name);
  }
  // What the linker puts in where a branch does not reach; called __TARGET_veneer.
  if (self.ends_with("_veneer"))
    names.insert(self.substr(2, self.size() - 2 - std::string("_veneer").size()));
  return names;
}

bool Function::calls_indirectly() const {
  for (const Instruction& i : instructions) {
    if (i.mnemonic.starts_with("blx") && i.operands.starts_with("r")) return true;
    if (i.mnemonic.starts_with("bx") && i.operands != "lr") return true;
    if (i.mnemonic.starts_with("mov") && i.operands.starts_with("pc,")) return true;
  }
  return false;
}

}  // namespace astro::target
