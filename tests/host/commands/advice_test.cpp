#include "host/commands/base/advice.hpp"

#include <gtest/gtest.h>

/// How advice stands behind a sentence. That its options and subcommands exist is tested with the program
/// (tests/host/programs/advice_test.cpp).
namespace astro::commands {
namespace {

enum class RunProblem { slipped, lost };
enum class OtherProblem { slipped };

constexpr Advice kTable[] = {{RunProblem::slipped, ": leave it out with --without {0}"}};

struct AdviceWords : testing::Test {
  AdviceWords() { advise(kTable); }
};

TEST_F(AdviceWords, FollowTheSentenceOfAnErrorAndOfARemark) {
  const Error error("run 3 slipped", RunProblem::slipped, {"3"});
  EXPECT_EQ(in_words(error), "run 3 slipped: leave it out with --without 3");
  EXPECT_EQ(in_words(error.remark()), "run 3 slipped: leave it out with --without 3");
}

TEST_F(AdviceWords, BelongToOneKindOfOneRoom) {
  EXPECT_EQ(in_words(Remark{"run 3 is lost", RunProblem::lost, {"3"}}), "run 3 is lost");
  EXPECT_EQ(in_words(Remark{"a wheel slipped", OtherProblem::slipped, {"3"}}), "a wheel slipped");
  EXPECT_EQ(in_words(Remark{"nothing to do"}), "nothing to do");
}

/// A value may come from a file; braces in it are no place for another value.
TEST_F(AdviceWords, TakeAValueAsItStands) {
  EXPECT_EQ(in_words(Remark{"it slipped", RunProblem::slipped, {"{}{0}"}}),
            "it slipped: leave it out with --without {}{0}");
}

/// Whoever throws may know no name.
TEST_F(AdviceWords, LeaveThePlaceOfAMissingValueOpen) {
  EXPECT_EQ(in_words(Remark{"it slipped", RunProblem::slipped}),
            "it slipped: leave it out with --without ...");
}

TEST_F(AdviceWords, AreKnownOnceHoweverOftenACommandGivesThem) {
  const std::size_t known = all_advice().size();
  advise(kTable);
  EXPECT_EQ(all_advice().size(), known);
}

}  // namespace
}  // namespace astro::commands
