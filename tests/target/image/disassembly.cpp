#include "tests/target/image/disassembly.hpp"

#include <algorithm>
#include <array>
#include <sstream>
#include <stdexcept>

#include "tests/target/image/binutils.hpp"

namespace astro::target {
namespace {

bool one_of(const std::string& text, std::initializer_list<const char*> choices) {
  return std::any_of(choices.begin(), choices.end(), [&](const char* choice) { return text == choice; });
}

/// Without the width of the encoding: "sub.w" is "sub".
std::string plain(const std::string& mnemonic) { return mnemonic.substr(0, mnemonic.find('.')); }

/// What lies between two marks; empty if one of them is missing.
std::string between(const std::string& text, const std::string& begin, const std::string& end) {
  const auto from = text.find(begin);
  const auto to = from == text.npos ? text.npos : text.find(end, from + begin.size());
  return to == text.npos ? "" : text.substr(from + begin.size(), to - from - begin.size());
}

std::uint32_t number(const std::string& text, int base = 10) {
  return static_cast<std::uint32_t>(std::stoul(text, nullptr, base));
}

/// "r4, r5, r6, lr"; objdump names each.
std::uint32_t registers_in(const std::string& list) {
  if (list.find('-') != list.npos) throw std::runtime_error("a range of registers: " + list);
  return 1 + static_cast<std::uint32_t>(std::count(list.begin(), list.end(), ','));
}

/// The mnemonic is one of these, with a condition or without: "bls" is a branch if lower or same, "blls" a
/// call.
bool conditional(const std::string& mnemonic, std::initializer_list<const char*> choices) {
  const std::string what = plain(mnemonic);
  if (one_of(what, choices)) return true;
  if (what.size() < 2 || !one_of(what.substr(what.size() - 2), {"eq", "ne", "cs", "cc", "mi", "pl", "vs",
                                                                "vc", "hi", "ls", "ge", "lt", "gt", "le"}))
    return false;
  return one_of(what.substr(0, what.size() - 2), choices);
}

bool is_branch(const std::string& mnemonic) {
  return conditional(mnemonic, {"b", "bl", "bx", "blx"}) || one_of(plain(mnemonic), {"cbz", "cbnz"});
}

bool writes_stack_pointer(const Instruction& i) {
  if (i.operands.starts_with("MSP") || i.operands.starts_with("PSP")) return true;
  const std::string what = plain(i.mnemonic);
  const bool only_reads = one_of(what, {"cmp", "cmn", "tst", "teq"}) || what.starts_with("st");
  return i.operands.starts_with("sp,") && !only_reads;
}

/// "sub sp, #8", "sub sp, sp, #8": nothing else is a step whose size can be read.
std::optional<std::uint32_t> constant_step(const Instruction& i) {
  const std::string what = plain(i.mnemonic);
  for (const std::string start : {"sp, sp, #", "sp, #"})
    if (i.operands.starts_with(start)) {
      if (one_of(what, {"add", "addw"})) return 0;
      if (one_of(what, {"sub", "subw"})) return number(i.operands.substr(start.size()));
    }
  return {};
}

/// "     34a:<tab>ldr<tab>r3, [pc, #16]<tab>@ (35c <f+0x12>)"; nothing for what is no instruction.
std::optional<Instruction> instruction(const std::string& line) {
  const auto colon = line.find(":\t");
  if (colon == line.npos) return {};
  std::istringstream cells(line.substr(colon + 2));
  Instruction i{number(line.substr(0, colon), 16), "", ""};
  std::getline(cells, i.mnemonic, '\t');
  std::getline(cells, i.operands, '\t');
  i.mnemonic = i.mnemonic.substr(0, i.mnemonic.find(' '));
  i.operands = i.operands.substr(0, i.operands.find(" @"));
  if (i.mnemonic.starts_with(".")) return {};  // a constant between functions
  return i;
}

std::map<std::string, Function> functions_of(const std::string& elf) {
  std::map<std::string, Function> functions;
  std::istringstream lines(output_of("arm-none-eabi-objdump -d --no-show-raw-insn '" + elf + "'"));
  Function* current = nullptr;
  for (std::string line; std::getline(lines, line);) {
    if (line.ends_with(">:"))
      current = &functions[between(line, "<", ">:")];
    else if (const auto found = instruction(line); found && current != nullptr)
      current->instructions.push_back(*found);
  }
  return functions;
}

/// A branch needs a relocation as an address does; everything else that names a function keeps its address.
bool is_of_a_branch(const std::string& kind) {
  return kind.starts_with("R_ARM_THM_CALL") || kind.starts_with("R_ARM_THM_JUMP") || kind == "R_ARM_NONE";
}

std::set<std::string> addresses_taken_in(const std::string& elf,
                                         const std::map<std::string, Function>& functions) {
  std::set<std::string> names;
  std::istringstream lines(output_of("arm-none-eabi-readelf -rW '" + elf + "'"));
  bool loaded = false;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::array<std::string, 5> word;  // offset, info, kind, value, name
    for (std::string& w : word) words >> w;
    if (word[0] == "Relocation")
      loaded = word[2].find(".debug") == word[2].npos && word[2].find(".ARM") == word[2].npos;
    const bool code = functions.contains(word[4]) || one_of(word[4], {".text", ".boot"});
    if (loaded && code && word[2].starts_with("R_ARM") && !is_of_a_branch(word[2])) names.insert(word[4]);
  }
  return names;
}

}  // namespace

std::optional<std::uint32_t> Instruction::stack_bytes() const {
  const std::string what = plain(mnemonic);
  const bool pushes =
      conditional(mnemonic, {"push"}) || (what.starts_with("stmdb") && operands.starts_with("sp!"));
  if (pushes) return 4 * registers_in(between(operands, "{", "}"));
  if (const std::string below = between(operands, "[sp, #-", "]!"); !below.empty()) return number(below);
  return writes_stack_pointer(*this) ? constant_step(*this) : 0;
}

std::string Instruction::branch_target() const {
  const auto open = operands.rfind('<');
  if (!is_branch(mnemonic) || open == std::string::npos) return "";
  const std::string name = operands.substr(open + 1, operands.rfind('>') - open - 1);
  return name.substr(0, name.find('+'));
}

bool Instruction::calls() const { return conditional(mnemonic, {"bl", "blx"}); }

bool Instruction::branches_into_the_middle() const {
  return !branch_target().empty() && operands.rfind('+') != std::string::npos;
}

bool Instruction::goes_through_pointer() const {
  const std::string what = plain(mnemonic);
  if (what == "blx" || what.starts_with("bx"))
    return operands.find('<') == std::string::npos && operands != "lr";
  const bool into_pc = operands.starts_with("pc,") && !what.starts_with("cmp");
  return into_pc && operands.find("[sp]") == std::string::npos;
}

bool Instruction::ends_a_path() const {
  const std::string what = plain(mnemonic);
  if (one_of(what, {"b", "bl", "bx", "udf", "bkpt", "tbb", "tbh"})) return true;  // a call may be for good
  if (what.starts_with("pop") || what.starts_with("ldm")) return operands.find("pc}") != std::string::npos;
  return operands.starts_with("pc,");
}

Program read_program(const std::string& elf) {
  Program program{functions_of(elf), {}};
  if (program.functions.empty()) throw std::runtime_error("no code in " + elf);
  program.addresses_taken = addresses_taken_in(elf, program.functions);
  return program;
}

}  // namespace astro::target
