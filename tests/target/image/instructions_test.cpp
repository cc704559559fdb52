#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/target/image/binutils.hpp"
#include "tests/target/image/disassembly.hpp"
#include "tests/target/image/hex_file.hpp"

namespace astro::target {
namespace {

using testing::Contains;
using testing::IsEmpty;

/// Functions with an instruction whose mnemonic begins so.
std::vector<std::string> with_instruction(const Program& program, const std::string& mnemonic) {
  std::vector<std::string> found;
  for (const auto& [name, function] : program.functions)
    for (const Instruction& i : function.instructions)
      if (i.mnemonic.starts_with(mnemonic))
        found.push_back(readable(name) + ": " + i.mnemonic + " " + i.operands);
  return found;
}

/// All that is neither written here, nor a view of the standard library, nor one of these: soft float, libm,
/// the heap, exceptions, printing, whatever a library brings along.
std::set<std::string> foreign(const Program& program) {
  static const std::set<std::string> known{
      "main",
      "reset",
      "start_from_flash",
      "fault_handler",
      "end_by_fault",  // boot
      "memcpy",
      "memmove",
      "memset",
      "memcmp",
      "memchr",  // newlib
      "__aeabi_ldivmod",
      "__aeabi_uldivmod",
      "__udivmoddi4",
      "__aeabi_idiv0",
      "__aeabi_ldiv0",  // 64-bit division
  };
  std::set<std::string> found;
  for (const auto& [name, function] : program.functions) {
    const std::string text = readable(name);
    const bool view = text.starts_with("std::basic_string_view<") || text.starts_with("std::span<") ||
                      text.starts_with("std::array<");
    const bool ours = view || name.find("5astro") != std::string::npos || text.starts_with("main::") ||
                      text.starts_with("(anonymous namespace)::") || name.ends_with("_veneer");
    if (!ours && !known.contains(text)) found.insert(text);
  }
  return found;
}

/// Where code in the flash goes on to code that is elsewhere, and must have been copied there before.
std::vector<std::string> ways_out_of_the_flash(const Program& program) {
  const auto in_flash = [](const Function& function) {
    return !function.instructions.empty() && function.instructions.front().address >= 0x6000'0000;
  };
  std::vector<std::string> targets;
  for (const auto& [name, function] : program.functions) {
    if (!in_flash(function)) continue;
    // The linker goes by way of a piece of its own, __TARGET_veneer, where a branch does not reach.
    if (name.ends_with("_veneer")) targets.push_back(name.substr(2, name.size() - 9));
    for (const Instruction& i : function.instructions)
      if (const auto to = program.functions.find(i.branch_target());
          to != program.functions.end() && !in_flash(to->second))
        targets.push_back(to->first);
  }
  return targets;
}

class Instructions : public testing::TestWithParam<const char*> {
 protected:
  const Program program_ = read_program(image("elf", GetParam()));
};

TEST_P(Instructions, UseNoFloat) {
  EXPECT_THAT(with_instruction(program_, "v"), IsEmpty());  // all of the FPU begin with it
}

TEST_P(Instructions, AreOursOrOfTheFewKnownLibraryFunctions) { EXPECT_THAT(foreign(program_), IsEmpty()); }

TEST_P(Instructions, OfTheStartStayInTheFlashUntilRamIsFilled) {
  const auto ways = ways_out_of_the_flash(program_);
  ASSERT_EQ(ways.size(), 1U);  // to run(), when it is
  EXPECT_EQ(readable(ways.front()), "astro::teensy40::(anonymous namespace)::run()");
}

INSTANTIATE_TEST_SUITE_P(Of, Instructions, testing::Values("astrolabe-teensy40", "blink"),
                         [](const auto& of) { return std::string(of.param).substr(0, 5); });

/// The companion chip takes any breakpoint for a call of the boot loader, whatever the motors do.
TEST(Breakpoint, IsOneAndCallsTheBootLoader) {
  EXPECT_THAT(with_instruction(read_program(image("elf")), "bkpt"),
              testing::ElementsAre("astro::teensy40::(anonymous namespace)::call_halfkay(): bkpt 0x00fb"));
  EXPECT_THAT(with_instruction(read_program(image("elf", "blink")), "bkpt"), IsEmpty());
}

class InstructionsControl : public testing::Test {
 protected:
  Program program(const std::string& code, const std::string& flags) {
    return read_program(control_.program("extern \"C\" { " + code + " }", flags));
  }
  Control control_;
};

TEST_F(InstructionsControl, AFloatInstructionIsFound) {
  EXPECT_THAT(
      with_instruction(
          program("float begin(float a) { return a * 1.5f; }", "-mfloat-abi=hard -mfpu=fpv5-d16"), "v"),
      Contains(testing::HasSubstr("begin: vmul")));
}

TEST_F(InstructionsControl, SoftFloatAndLibraryFunctionsAreFound) {
  const auto found =
      foreign(program("float sinf(float); double begin(double a, int b) { return a * 1.5 + "
                      "static_cast<float>(b) + sinf(1.5f + b); }",
                      "-mfloat-abi=soft -lm"));
  EXPECT_THAT(found, Contains("__aeabi_dmul"));
  EXPECT_THAT(found, Contains("__aeabi_i2f"));
  EXPECT_THAT(found, Contains("sinf"));
}

TEST_F(InstructionsControl, TheHeapIsFound) {
  const auto found =
      foreign(program("void* __dso_handle; int* begin() { return new int; }", "-fno-exceptions"));
  EXPECT_THAT(found, Contains("operator new(unsigned int)"));
  EXPECT_THAT(found, Contains("malloc"));
}

TEST_F(InstructionsControl, ACallFromTheFlashIntoRamIsFound) {
  const auto found = program(
      "[[gnu::noinline]] void copy() { asm volatile(\"nop\"); }"
      "[[gnu::section(\".boot\")]] int begin() { copy(); return 1; }",
      "-fno-exceptions -Wl,--section-start=.boot=0x60001030");
  EXPECT_THAT(ways_out_of_the_flash(found), testing::ElementsAre("copy"));
}

TEST_F(InstructionsControl, ABreakpointIsFound) {
  EXPECT_THAT(with_instruction(program("void begin() { asm volatile(\"bkpt #171\"); }", ""), "bkpt"),
              testing::ElementsAre("begin: bkpt 0x00ab"));
}

}  // namespace
}  // namespace astro::target
