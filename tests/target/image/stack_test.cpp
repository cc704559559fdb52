#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iostream>
#include <set>
#include <sstream>

#include "tests/target/image/binutils.hpp"
#include "tests/target/image/call_graph.hpp"
#include "tests/target/image/hex_file.hpp"
#include "tests/target/image/pointers.hpp"

namespace astro::target {
namespace {

using testing::Contains;
using testing::HasSubstr;

std::uint32_t reserved_bytes() {
  std::istringstream lines(output_of("arm-none-eabi-nm --defined-only '" + image("elf") + "'"));
  std::uint32_t top = 0, bottom = 0;
  for (std::string line; std::getline(lines, line);) {
    if (line.ends_with(" stack_top")) top = static_cast<std::uint32_t>(std::stoul(line, nullptr, 16));
    if (line.ends_with(" stack_bottom")) bottom = static_cast<std::uint32_t>(std::stoul(line, nullptr, 16));
  }
  return top - bottom;
}

TEST(Stack, WorstCaseFitsAndNothingCallsItself) {
  CallGraph graph(read_program(image("elf")), kPointers);
  const std::uint32_t worst = graph.worst_case("reset");
  std::cout << "  main program " << graph.deepest("reset") << ": " << graph.chain("reset") << "\n";
  for (const auto& [handler, urgency] : kPointers.handlers)
    std::cout << "  urgency " << urgency << " " << graph.deepest(handler) << ": " << graph.chain(handler)
              << "\n";
  std::cout << "  worst case " << worst << " bytes of " << reserved_bytes() << "\n";
  EXPECT_THAT(graph.problems(), testing::IsEmpty());
  EXPECT_GT(graph.deepest("reset"), graph.deepest("main"));
  EXPECT_LE(worst, reserved_bytes());
}

using ByLine = std::map<std::string, std::uint32_t>;

/// What the compiler says that functions take, by "file:line". Not those of which several begin on one line:
/// of a template the image may keep some instances and inline the others.
ByLine stated_by_compiler() {
  ByLine bytes;
  std::map<std::string, std::set<std::string>> functions;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(ASTRO_IMAGE_DIR "/..")) {
    const std::string name = entry.path().filename();
    const bool of_another_image =
        entry.path().parent_path().filename() == "bin" && !name.starts_with("astrolabe");
    if (!name.ends_with(".su") || of_another_image) continue;
    std::ifstream file(entry.path());
    for (std::string line; std::getline(file, line);) {
      const std::string place = line.substr(0, line.find(':', line.find(':') + 1));
      const auto tab = line.find('\t');
      const std::string key = place.substr(place.rfind('/') + 1);
      functions[key].insert(line.substr(0, tab));
      std::uint32_t& most = bytes[key];
      most = std::max(most, static_cast<std::uint32_t>(std::stoul(line.substr(tab))));
      EXPECT_TRUE(line.ends_with("\tstatic")) << line;
    }
  }
  std::erase_if(bytes, [&](const auto& one) { return functions[one.first].size() > 1; });
  return bytes;
}

/// The same from the image itself.
ByLine found_in_image() {
  ByLine bytes;
  const auto of = frames(read_program(image("elf")));
  std::istringstream lines(output_of("arm-none-eabi-nm -l '" + image("elf") + "'"));
  for (std::string line; std::getline(lines, line);) {
    const auto tab = line.find('\t');
    if (tab == std::string::npos) continue;
    const std::string name = line.substr(11, tab - 11), place = line.substr(line.rfind('/') + 1);
    if (const auto found = of.find(name); found != of.end())
      bytes[place] = std::max(bytes[place], found->second);
  }
  return bytes;
}

/// Two ways to the same number: -fstack-usage, which knows nothing of libraries and assembly, and the
/// disassembly, which adds up all paths of a function and so may only find more.
TEST(Stack, FramesAreAtLeastThoseThatTheCompilerStates) {
  const ByLine stated = stated_by_compiler(), found = found_in_image();
  int compared = 0;
  for (const auto& [place, bytes] : stated)
    if (const auto same = found.find(place); same != found.end()) {
      EXPECT_GE(same->second, bytes) << place;
      ++compared;
    }
  std::cout << "  " << compared << " functions compared\n";
  EXPECT_GT(compared, 50);
}

/// In assembly, so that the figures below are known: 8 + 24, then 16 + 12, then 4; a handler of 8.
constexpr const char* kKnown = R"(
#define F(name) ".global " #name "\n.thumb_func\n.type " #name ", %function\n" #name ":\n"
asm(".syntax unified\n.text\n"
  F(begin)   "push {r4, lr}\nsub sp, #24\nbl middle\nadd sp, #24\npop {r4, pc}\n"
  F(middle)  "strd r0, lr, [sp, #-16]!\nstmdb sp!, {r4-r6}\nbl leaf\nadd sp, #28\nbx lr\n"
  F(leaf)    "str lr, [sp, #-4]!\ncbz r0, 1f\nnop\n1: ldr pc, [sp], #4\n"
  F(handler) "push {r3, lr}\nblx r3\npop {r3, pc}\n"
  F(stranger) "bx lr\n"
  ".word handler, leaf\n");
)";

class StackControl : public testing::Test {
 protected:
  CallGraph graph(const std::string& source, const Pointers& pointers = {}, const std::string& flags = "") {
    CallGraph graph(read_program(control_.program(source, flags)), pointers);
    graph.deepest("begin");
    return graph;
  }
  Control control_;
};

TEST_F(StackControl, AKnownDepthIsFound) {
  auto known = graph(kKnown, {{{"handler", {"leaf"}}}, {{"handler", 2}}, {}});
  EXPECT_EQ(known.deepest("begin"), 32U + 28 + 4);
  EXPECT_EQ(known.deepest("handler"), 8U + 4);
  EXPECT_EQ(known.worst_case("begin"), 64U + 12 + 2 * 36);
  EXPECT_THAT(known.problems(), testing::IsEmpty());
}

TEST_F(StackControl, HandlersOfOneUrgencyDoNotInterruptEachOther) {
  const Pointers same{{{"handler", {"leaf"}}}, {{"handler", 2}, {"leaf", 2}}, {}};
  const Pointers nested{{{"handler", {"leaf"}}}, {{"handler", 2}, {"leaf", 3}}, {}};
  EXPECT_EQ(graph(kKnown, nested).worst_case("begin"), graph(kKnown, same).worst_case("begin") + 4 + 36);
}

TEST_F(StackControl, AnAddressThatIsTakenForNobodyIsFound) {
  EXPECT_THAT(graph(kKnown, {{{"handler", {"leaf"}}}, {}, {}}).problems(),
              Contains(HasSubstr("handler has its address taken")));
}

TEST_F(StackControl, ACallThroughAnUnknownPointerIsFound) {
  auto known = graph(kKnown, {{}, {{"handler", 2}, {"leaf", 2}}, {}});
  known.worst_case("begin");
  EXPECT_THAT(known.problems(), Contains(HasSubstr("handler calls through a pointer")));
}

TEST_F(StackControl, AListedFunctionThatIsGoneIsFound) {
  auto known = graph(kKnown, {{{"handler", {"leaf", "gone"}}}, {{"handler", 2}}, {}});
  known.worst_case("begin");
  EXPECT_THAT(known.problems(), Contains(HasSubstr("gone is listed")));
}

TEST_F(StackControl, ARecursionIsFound) {
  const auto found = graph(
      "extern \"C\" { int g(int); [[gnu::noinline]] int f(int n) { return n > 0 ? g(n - 1) * 3 : 0; }"
      " [[gnu::noinline]] int g(int n) { return n > 1 ? f(n - 2) * 5 : 1; } int begin(int n) { return f(n) + "
      "1; } }",
      {}, "-fno-ipa-cp -fno-inline");
  EXPECT_THAT(found.problems(), Contains(HasSubstr("recursion: f -> g -> f")));
}

TEST_F(StackControl, AnAmountThatOnlyRunningShowsIsFound) {
  const auto found = graph(
      "extern \"C\" { [[gnu::noinline]] void use(char* p) { asm volatile(\"\" :: \"r\"(p) : \"memory\"); }"
      " void begin(int n) { use(static_cast<char*>(__builtin_alloca(n))); } }");
  EXPECT_THAT(found.problems(),
              Contains(HasSubstr("begin takes an amount of stack that only running shows")));
}

}  // namespace
}  // namespace astro::target
