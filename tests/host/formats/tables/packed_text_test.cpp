#include "host/formats/tables/packed_text.hpp"

#include <gmock/gmock.h>

#include "tests/support/base/gzip.hpp"
#include "tests/support/base/remarks.hpp"

namespace astro::tables {
namespace {

using support::gzip;
using support::Tells;
using support::told_by;

std::string text_of(ByteView packed, const std::string& name = "x") {
  MemorySource source(packed);
  return std::string(as_text(unpacked(source, name)));
}

TEST(PackedText, IsTheTextThatWasPacked) {
  std::string text;
  for (int i = 0; i < 50'000; ++i) text += std::to_string(i) + ",1.25\n";
  EXPECT_TRUE(is_gzip(gzip(text)));
  EXPECT_EQ(text_of(gzip(text)), text);
  EXPECT_FALSE(is_gzip(Bytes{'F', 'o', 'r'}));
}

TEST(PackedText, OfSeveralPartsIsAllOfThem) {
  Bytes both = gzip("first\n");
  const Bytes second = gzip("second\n");
  both.insert(both.end(), second.begin(), second.end());
  EXPECT_EQ(text_of(both), "first\nsecond\n");
}

TEST(PackedText, ThatIsCutOffAnywhereIsRefused) {
  const Bytes whole = gzip("a line of text that is long enough\n");
  for (std::size_t size = 3; size < whole.size(); ++size)
    EXPECT_THAT(told_by([&] {
                  text_of({whole.data(), size}, "take.csv.gz");
                }),
                Tells(PackedProblem::cut_off, "take.csv.gz", std::to_string(size)))
        << size;
}

TEST(PackedText, ThatIsDamagedIsTheTextOrRefusedAndNothingElse) {
  const std::string text = "1,2,3\n4,5,6\n7,8,9\n";
  const Bytes whole = gzip(text);
  for (std::size_t i = 0; i < whole.size(); ++i)
    for (const unsigned flip : {0x01u, 0x80u, 0xFFu}) {
      Bytes damaged = whole;
      damaged[i] = static_cast<std::uint8_t>(damaged[i] ^ flip);
      if (!is_gzip(damaged)) continue;
      try {
        EXPECT_EQ(text_of(damaged), text) << i;  // a byte of the header that means nothing
      } catch (const Error&) {
      }
    }
}

TEST(PackedText, ThatWouldFillTheMemoryIsRefused) {
  const Bytes bomb = gzip(std::string(std::size_t{64} << 20, '0'));
  EXPECT_LT(bomb.size(), 100'000u);
  EXPECT_THAT(told_by([&] { text_of(bomb, "bomb.gz"); }), Tells(PackedProblem::too_large, "bomb.gz", "56"));
  const Bytes lines = gzip(std::string(std::size_t{1} << 20, '\n'));
  EXPECT_THAT(told_by([&] { text_of(lines, "lines.gz"); }),
              Tells(PackedProblem::too_large, "lines.gz", "56"));
}

}  // namespace
}  // namespace astro::tables
