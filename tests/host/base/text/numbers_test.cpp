#include "host/base/text/numbers.hpp"

#include <gmock/gmock.h>

#include "host/base/bytes.hpp"
#include "host/base/text/number_problem.hpp"
#include "tests/support/base/remarks.hpp"

namespace astro {
namespace {

TEST(TypedNumber, MayHaveAPlusSignAndIsFinite) {
  EXPECT_EQ(typed_number("+2.5"), 2.5);
  EXPECT_EQ(typed_number("-1e-3"), -1e-3);
  for (const char* text : {"", "+", "++1", "1 m", "1,5", "inf", "nan", " 1"})
    EXPECT_EQ(typed_number(text), std::nullopt) << text;
}

TEST(TakeNumber, LeavesTheRestOfTheText) {
  std::string_view text = "40rad/s";
  EXPECT_EQ(take_number<double>(text), 40);
  EXPECT_EQ(text, "rad/s");
}

TEST(TakeNumber, LeavesATextThatBeginsWithNoNumber) {
  std::string_view text = "rad/s";
  EXPECT_EQ(take_number<double>(text), std::nullopt);
  EXPECT_EQ(text, "rad/s");
}

TEST(WholeNumbers, AreRefusedBeyondTheirTypeAndBeforeOtherText) {
  EXPECT_EQ(unsigned_in("18446744073709551615"), 18'446'744'073'709'551'615U);
  for (const char* text : {"18446744073709551616", "-1", "1.0", "7 ", ""})
    EXPECT_EQ(unsigned_in(text), std::nullopt) << text;
}

TEST(CountsOfAFile, AreWholeNumbersOrRefusedAsTheyAreWritten) {
  EXPECT_EQ(count_in("0", "runs"), 0);
  EXPECT_EQ(count_in("2147483647", "runs"), 2'147'483'647);
  for (const std::string text : {"2147483648", "-1", "1e300", "5.0", "true", "\"5\"", "null", ""})
    EXPECT_THAT([&] { count_in(text, "runs"); },
                support::ThrowsTelling(NumberProblem::not_a_count, "runs", text));
}

TEST(StoredNumbers, AreLittleEndianAndReadBack) {
  Bytes bytes(6, 0xAA);
  store(bytes, 1, std::uint32_t{0x01020304});
  EXPECT_EQ(bytes, (Bytes{0xAA, 4, 3, 2, 1, 0xAA}));
  EXPECT_EQ(load<std::uint32_t>(bytes, 1), 0x01020304U);
}

}  // namespace
}  // namespace astro
