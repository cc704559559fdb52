#include "tests/host/guides/page.hpp"

#include <gmock/gmock.h>

// How pages are read, without which a page could show anything.
namespace astro::guides {
namespace {

TEST(Page, HasACommandAndItsOutputByHowFarTheyStandIn) {
  const std::vector<Command> commands = commands_of(
      "# Title\n\nText with `astrolabe info`.\n\n    astrolabe drive line 1 \\\n        --speed 0.3\n      "
      "drove 1 m\n"
      "      ...\n    ros2 topic list\n\n## Next\n    astrolabe info\n");
  ASSERT_EQ(commands.size(), 3U);
  EXPECT_EQ(commands[0].text, "astrolabe drive line 1 --speed 0.3");
  EXPECT_EQ(commands[0].line, 5);
  EXPECT_THAT(commands[0].shown, testing::ElementsAre("drove 1 m", "..."));
  EXPECT_TRUE(commands[0].is_ours());
  EXPECT_FALSE(commands[1].is_ours());
  EXPECT_THAT(commands[2].shown, testing::IsEmpty());
}

TEST(Page, HasFilesBetweenFencesThatTheReaderWrites) {
  const std::vector<Command> commands =
      commands_of("Text\n\n```python a.py\nif x:\n    y()\n```\n\n    python3 a.py\n      z\n");
  ASSERT_EQ(commands.size(), 2U);
  EXPECT_EQ(commands[0].text, "cat > a.py <<'END'\nif x:\n    y()\nEND");
  EXPECT_EQ(commands[0].line, 3);
  EXPECT_EQ(commands[1].text, "python3 a.py");
  EXPECT_EQ(commands[1].line, 8);
  EXPECT_THAT(commands[1].shown, testing::ElementsAre("z"));
}

TEST(Page, IsHeldToTheLinesItShowsInTheirOrder) {
  const std::string output = "one\ntwo   and a half\nthree\n";
  EXPECT_EQ(missing_line({"one", "three"}, output), "");
  EXPECT_EQ(missing_line({"two and a half"}, output), "");
  EXPECT_EQ(missing_line({"three", "one"}, output), "one");
  EXPECT_EQ(missing_line({"four"}, output), "four");
  EXPECT_EQ(missing_line({"t...half", "..."}, output), "");
  EXPECT_EQ(missing_line({"two"}, output), "two") << "a line is compared as a whole";
}

TEST(Page, IsHeldToItsNumbersAsCloselyAsDrivesRepeat) {
  EXPECT_EQ(missing_line({"414 mm -> 76 mm"}, "380 mm -> 90 mm"), "");
  EXPECT_EQ(missing_line({"414 mm -> 76 mm"}, "414 mm -> 176 mm"), "414 mm -> 76 mm");
  EXPECT_EQ(missing_line({"c_R = 1.0021"}, "c_R = 1.0019"), "");
  EXPECT_EQ(missing_line({"v1.2.3"}, "v1.2.9"), "v1.2.3");
  EXPECT_EQ(missing_line({"in 3 s"}, "in x s"), "in 3 s");
}

}  // namespace
}  // namespace astro::guides
