#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>

#include "tests/target/image/disassembly.hpp"
#include "tests/target/image/hex_file.hpp"

namespace astro::target {
namespace {

/// Where calls through a pointer lead, by a part of the linker's name. A new one fails the test until it is
/// here.
const std::map<std::string, std::vector<std::string>> kIndirect{
    {"pit_interrupt", {"main::{lambda", "_ZZ4mainENUlvE", "_FUN"}},  // the tick that main() installs
    {"3runEv", {"_GLOBAL__sub_I"}},                                  // constructors
};

/// Handlers by how urgent they are: each may interrupt the ones before it, and main().
const std::vector<std::vector<std::string>> kLevels{{"4Uart9interruptEv"}, {"pit_interrupt"}};

/// The core stores eight registers, and a word more if the stack is not aligned to eight.
constexpr std::uint32_t kExceptionFrame = 32 + 4;

class CallGraph {
 public:
  explicit CallGraph(const std::string& elf) : functions_(disassemble(elf)) {}

  std::vector<std::string> named(const std::string& part) const {
    std::vector<std::string> names;
    for (const auto& [name, function] : functions_)
      if (name.find(part) != std::string::npos) names.push_back(name);
    return names;
  }

  std::uint32_t deepest(const std::string& name) {
    if (const auto known = depth_.find(name); known != depth_.end()) return known->second;
    if (std::find(path_.begin(), path_.end(), name) != path_.end()) {
      std::string cycle;
      for (auto it = std::find(path_.begin(), path_.end(), name); it != path_.end(); ++it)
        cycle += *it + " -> ";
      recursions.push_back(cycle + name);
      return 0;
    }
    path_.push_back(name);
    std::uint32_t below = 0;
    for (const std::string& callee : callees(name))
      if (const std::uint32_t depth = deepest(callee); depth > below) {
        below = depth;
        next_[name] = callee;
      }
    path_.pop_back();
    return depth_[name] = below + (functions_.contains(name) ? functions_.at(name).frame_bytes() : 0);
  }

  std::string chain(std::string name) {
    std::string text = name;
    while (next_.contains(name)) text += " -> " + (name = next_[name]);
    return text;
  }

  std::vector<std::string> recursions, unknown_indirect;

 private:
  std::set<std::string> callees(const std::string& name) {
    const auto found = functions_.find(name);
    if (found == functions_.end()) return {};
    std::set<std::string> names = found->second.callees(name);
    if (!found->second.calls_indirectly()) return names;
    for (const auto& [part, targets] : kIndirect)
      if (name.find(part) != std::string::npos) {
        for (const std::string& target : targets)
          for (const std::string& match : named(target)) names.insert(match);
        return names;
      }
    unknown_indirect.push_back(name);
    return names;
  }

  std::map<std::string, Function> functions_;
  std::map<std::string, std::uint32_t> depth_;
  std::map<std::string, std::string> next_;
  std::vector<std::string> path_;
};

std::uint32_t reserved() {
  std::istringstream lines(output_of("arm-none-eabi-nm --defined-only '" + image("elf") + "'"));
  std::uint32_t top = 0, bottom = 0;
  for (std::string line; std::getline(lines, line);) {
    if (line.ends_with(" stack_top")) top = static_cast<std::uint32_t>(std::stoul(line, nullptr, 16));
    if (line.ends_with(" stack_bottom")) bottom = static_cast<std::uint32_t>(std::stoul(line, nullptr, 16));
  }
  return top - bottom;
}

TEST(Stack, WorstCaseFitsAndNothingCallsItself) {
  CallGraph graph(image("elf"));
  std::uint32_t worst = graph.deepest("reset");
  std::cout << "  main program " << worst << " bytes: " << graph.chain("reset") << "\n";
  ASSERT_GT(worst, 500U) << "the way from reset to the main loop was not found";
  for (const auto& level : kLevels) {
    std::uint32_t deepest = 0;
    for (const std::string& part : level)
      for (const std::string& handler : graph.named(part)) {
        const std::uint32_t depth = graph.deepest(handler) + kExceptionFrame;
        std::cout << "  interrupt " << depth << " bytes: " << graph.chain(handler) << "\n";
        deepest = std::max(deepest, depth);
      }
    ASSERT_GT(deepest, 0U) << level.front() << " was not found";
    worst += deepest;
  }
  std::cout << "  worst case " << worst << " bytes of " << reserved() << "\n";
  EXPECT_EQ(graph.recursions, std::vector<std::string>{});
  EXPECT_EQ(graph.unknown_indirect, std::vector<std::string>{});
  EXPECT_LE(worst, reserved());
}

TEST(Stack, NoFunctionTakesAnAmountThatOnlyRunningShows) {
  int functions = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(ASTRO_IMAGE_DIR "/..")) {
    if (entry.path().extension() != ".su") continue;
    std::ifstream file(entry.path());
    for (std::string line; std::getline(file, line); ++functions)
      EXPECT_TRUE(line.ends_with("\tstatic")) << line;
  }
  EXPECT_GT(functions, 50);
}

TEST(Stack, TheCheckFindsARecursion) {
  const std::filesystem::path folder = testing::TempDir();
  const std::string source = folder / "recursion.cpp", object = folder / "recursion.o";
  std::ofstream(source)
      << "extern \"C\" int g(int); extern \"C\" int f(int n) { return n > 0 ? g(n - 1) + 1 : 0; }"
         "extern \"C\" __attribute__((noinline)) int g(int n) { return n > 0 ? f(n - 1) * 3 : 1; }";
  output_of("arm-none-eabi-g++ -mcpu=cortex-m7 -mthumb -O1 -fno-optimize-sibling-calls -fno-inline -c -o '" +
            object + "' '" + source +
            "'"
            " && arm-none-eabi-ld -r -o '" +
            object + ".elf' '" + object + "'");
  CallGraph graph(object + ".elf");
  graph.deepest("f");
  EXPECT_FALSE(graph.recursions.empty());
}

}  // namespace
}  // namespace astro::target
