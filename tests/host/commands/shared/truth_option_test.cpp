#include "host/commands/shared/truth_option.hpp"

#include <gtest/gtest.h>

namespace astro::commands {
namespace {

using truth::AnswerKind;

TEST(TruthQuestion, NamesTheKeyThatAnswersIt) {
  EXPECT_EQ(in_words(truth::Question{"there is no file 'a.csv'", {}, AnswerKind::file_saved}),
            "there is no file 'a.csv'; press Enter once it is there: ");
  EXPECT_EQ(
      in_words(truth::Question{"", {"'a.csv', line 3: 'nan' is no number", {}}, AnswerKind::file_corrected}),
      "'a.csv', line 3: 'nan' is no number; press Enter once the file is corrected: ");
  EXPECT_EQ(in_words(truth::Question{"'a.csv': too far.", {}, AnswerKind::file_corrected_or_kept}),
            "'a.csv': too far. Press Enter once the file is corrected, or to keep it as it is: ");
}

TEST(TruthQuestion, ForAValueIsThePromptAlone) {
  EXPECT_EQ(in_words(truth::Question{"measured end x: "}), "measured end x: ");
}

}  // namespace
}  // namespace astro::commands
