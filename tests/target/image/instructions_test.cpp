#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>

#include "tests/target/image/disassembly.hpp"
#include "tests/target/image/hex_file.hpp"

namespace astro::target {
namespace {

/// All FPU instructions of the Cortex-M7 begin with v.
std::set<std::string> with_fpu(const std::map<std::string, Function>& functions) {
  std::set<std::string> names;
  for (const auto& [name, function] : functions)
    for (const Instruction& i : function.instructions)
      if (i.mnemonic.starts_with("v")) names.insert(name + ": " + i.mnemonic);
  return names;
}

/// What the compiler calls for float arithmetic, what libm offers, and the heap.
std::set<std::string> unwanted(const std::set<std::string>& names) {
  static const std::regex pattern(
      "__aeabi_(c?[fd](add|sub|rsub|mul|div|neg|cmp.*|2.*)|.*2[fdh])|__(add|sub|mul|div)[sd]f3|"
      "(sin|cos|tan|asin|acos|atan|atan2|sqrt|pow|exp|log|floor|ceil|round|fmod|fabs)f?|"
      "_?malloc(_r)?|_?calloc(_r)?|_?realloc(_r)?|_?free(_r)?|_sbrk(_r)?|_Zn[wa].*|_Zd[la].*|__cxa_(throw|"
      "allocate).*|"
      "printf.*|_printf.*|abort|raise|_kill|_write");
  std::set<std::string> found;
  for (const std::string& name : names)
    if (std::regex_match(name, pattern)) found.insert(name);
  return found;
}

TEST(Image, HasNoFloatInstruction) {
  EXPECT_EQ(with_fpu(disassemble(image("elf"))), std::set<std::string>{});
}

TEST(Image, HasNoSoftFloatNoMathLibraryAndNoHeap) {
  EXPECT_EQ(unwanted(symbols(image("elf"))), std::set<std::string>{});
}

/// Compiles a few lines for the same processor, so that the checks above are seen to find something.
class Control : public testing::Test {
 protected:
  std::string object(const std::string& source, const std::string& flags) {
    const std::filesystem::path folder = testing::TempDir();
    const std::string path = folder / "control.cpp", out = folder / "control.o";
    std::ofstream(path) << source;
    output_of("arm-none-eabi-g++ -mcpu=cortex-m7 -mthumb -O2 -c " + flags + " -o '" + out + "' '" + path +
              "'");
    return out;
  }
};

TEST_F(Control, AFloatProductIsFoundAsAnInstruction) {
  const auto found = with_fpu(
      disassemble(object("float f(float a) { return a * 1.5f; }", "-mfloat-abi=hard -mfpu=fpv5-d16")));
  EXPECT_FALSE(found.empty());
}

TEST_F(Control, AFloatProductAndAHeapAreFoundAsSymbols) {
  const auto found =
      unwanted(symbols(object("double f(double a) { return a * 1.5; } float g(int a) { return a; }"
                              "int* h() { return new int; }",
                              "-mfloat-abi=soft")));
  EXPECT_TRUE(found.contains("__aeabi_dmul"));
  EXPECT_TRUE(found.contains("__aeabi_i2f"));
  EXPECT_TRUE(found.contains("_Znwj"));
}

TEST(Image, HasOneBreakpointWhichCallsTheBootLoader) {
  std::vector<std::string> found;
  for (const auto& [name, function] : disassemble(image("elf")))
    for (const Instruction& i : function.instructions)
      if (i.mnemonic.starts_with("bkpt")) found.push_back(name + " " + i.operands);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NE(found[0].find("call_halfkay"), std::string::npos) << found[0];
  EXPECT_NE(found[0].find("0x00fb"), std::string::npos) << found[0];
}

}  // namespace
}  // namespace astro::target
