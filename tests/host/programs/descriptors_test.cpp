#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <sstream>
#include <vector>

#include "tests/support/programs/program.hpp"

// A program that may open few files: it works, or says in one sentence that these are too few.
namespace astro {
namespace {

using testing::HasSubstr;
using testing::Not;

support::Outcome with_descriptors(int most, const std::string& words) {
  support::Program program(
      {"/bin/sh", "-c",
       fmt::format("ulimit -n {} || exit 99; exec timeout 20 '{}' {}", most, ASTROLABE_PROGRAM, words)});
  const int code = program.wait();
  return {code, program.out(), program.err()};
}

void works_or_says_why(const std::string& words) {
  int refused = 0;
  for (int most = 5; most <= 24; ++most) {
    SCOPED_TRACE(fmt::format("{} descriptors: {}", most, words));
    const support::Outcome outcome = with_descriptors(most, words);
    // Below some number not even the libraries of a program can be loaded, or 'timeout' run.
    if (outcome.code == 0 || outcome.code == 126 || outcome.code == 127) continue;
    ++refused;
    EXPECT_EQ(outcome.code, 1) << outcome.err;
    EXPECT_THAT(outcome.err, Not(HasSubstr("should not have happened")));
    EXPECT_THAT(outcome.err, HasSubstr("as many files open as its limit allows"));
    // Before it there may be a remark that no other program can use the port meanwhile.
    std::vector<std::string> sentences;
    std::istringstream text(outcome.err);
    for (std::string line; std::getline(text, line);) sentences.push_back(line);
    ASSERT_FALSE(sentences.empty());
    EXPECT_EQ(
        std::ranges::count_if(sentences, [](const auto& line) { return line.starts_with("astrolabe: "); }), 1)
        << outcome.err;
    EXPECT_TRUE(sentences.back().starts_with("astrolabe: ")) << outcome.err;
  }
  EXPECT_GT(refused, 0) << words;
  EXPECT_EQ(with_descriptors(64, words).code, 0) << words;
}

TEST(FewDescriptors, AreEnoughForARobotOrOneSentenceSaysThatTheyAreNot) {
  const support::Simulator simulator;
  works_or_says_why("info --port " + simulator.port());
  works_or_says_why("stop --port " + simulator.port());
}

TEST(FewDescriptors, AreEnoughForTwoProgramsAtARobotOrOneSentenceSaysThatTheyAreNot) {
  const support::Simulator simulator;
  support::Program holder({ASTROLABE_PROGRAM, "monitor", "--port", simulator.port(), "--json"});
  ASSERT_TRUE(support::eventually([&] { return !holder.out().empty(); })) << holder.err();
  works_or_says_why("params list --port " + simulator.port());
}

}  // namespace
}  // namespace astro
