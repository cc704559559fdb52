#include "host/base/text/plain_text.hpp"

#include <gtest/gtest.h>

#include <random>
#include <string>

namespace astro {
namespace {

TEST(PlainText, LeavesWhatPeopleWriteAsItIs) {
  for (const std::string text : {"", "astro", "a\tb\nc", "Größe 3 m", "±0.05 %", "机器人", "🤖", "█░┃"})
    EXPECT_EQ(plain_text(text), text);
}

TEST(PlainText, TakesAwayWhatMovesATerminal) {
  EXPECT_EQ(plain_text("\033[31mred\033[0m"), "�[31mred�[0m");
  EXPECT_EQ(plain_text("\033]0;title\a"), "�]0;title�");
  EXPECT_EQ(plain_text("over\rwritten\b\x7F"), "over�written��");
  EXPECT_EQ(plain_text(std::string("nul\0end", 7)), "nul�end");
  EXPECT_EQ(plain_text("\xC2\x9B"
                       "31m"),
            "�31m")
      << "C1: the CSI of an 8-bit terminal";
  EXPECT_EQ(plain_text("\xE2\x80\xAE"
                       "desrever\xE2\x81\xA6"),
            "�desrever�")
      << "direction of writing";
  EXPECT_EQ(plain_text("a\xD8\x9C"
                       "b"),
            "a�b")
      << "the Arabic mark of direction";
  EXPECT_EQ(plain_text("a\xE2\x80\xA8"
                       "b"),
            "a�b")
      << "line separator";
}

TEST(PlainText, ReplacesEveryByteThatIsNoUtf8) {
  EXPECT_EQ(plain_text("\xFF\xFE"), "��");
  EXPECT_EQ(plain_text("\xC3"), "�") << "cut inside a character";
  EXPECT_EQ(plain_text("\xC0\xAF"), "��") << "longer than it must be";
  EXPECT_EQ(plain_text("\xE0\x80\x80"), "���");
  EXPECT_EQ(plain_text("\xF0\x80\x80\x80"), "����");
  EXPECT_EQ(plain_text("\xED\xA0\x80"), "���") << "a surrogate";
  EXPECT_EQ(plain_text("\xF4\x90\x80\x80"), "����") << "above U+10FFFF";
  EXPECT_EQ(plain_text("\x9B"
                       "31m"),
            "�31m");
  EXPECT_EQ(plain_text("\xC3(\xC3\xBC"), "�(ü");
}

TEST(PlainText, OfAnyBytesIsPlainAlready) {
  constexpr unsigned kSeed = 20261122;
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  std::mt19937 random(kSeed);
  for (int round = 0; round < 20'000; ++round) {
    std::string bytes(random() % 12, '\0');
    for (char& byte : bytes) byte = static_cast<char>(random());
    const std::string plain = plain_text(bytes);
    ASSERT_EQ(plain_text(plain), plain);
    for (const char c : plain) ASSERT_TRUE(static_cast<unsigned char>(c) >= 0x20 || c == '\n' || c == '\t');
  }
}

}  // namespace
}  // namespace astro
