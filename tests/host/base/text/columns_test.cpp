#include "host/base/text/columns.hpp"

#include <gtest/gtest.h>

namespace astro {
namespace {

TEST(Columns, AreCountedInCharactersNotInBytes) {
  EXPECT_EQ(columns_of("äöü ±"), 5U);
  EXPECT_EQ(columns_of(""), 0U);
}

TEST(Columns, ThatAreTooManyAreCutBetweenCharacters) {
  EXPECT_EQ(clipped("äöü", 2), "äö");
  EXPECT_EQ(clipped("█░", 5), "█░");
  EXPECT_EQ(clipped("abc", 0), "");
}

TEST(Wrapped, TextIsBrokenBetweenWordsAndEndsWithANewline) {
  EXPECT_EQ(wrapped("ab cd ef", 5), "ab cd\nef\n");
  EXPECT_EQ(wrapped("äö cd ef", 5), "äö cd\nef\n");
  EXPECT_EQ(wrapped("short"), "short\n");
  EXPECT_EQ(wrapped(""), "\n");
  EXPECT_EQ(wrapped(std::string(40, 'a') + ' ' + std::string(40, 'b')),
            std::string(40, 'a') + '\n' + std::string(40, 'b') + '\n');
}

TEST(Wrapped, WordThatIsTooLongHasALineOfItsOwn) { EXPECT_EQ(wrapped("a bcdefgh i", 4), "a\nbcdefgh\ni\n"); }

TEST(Wrapped, MarginBeginsEachLineAndCounts) {
  EXPECT_EQ(wrapped("ab cd ef", 7, "# "), "# ab cd\n# ef\n");
  EXPECT_EQ(wrapped("ab cd ef", 6, "# "), "# ab\n# cd\n# ef\n");
}

}  // namespace
}  // namespace astro
