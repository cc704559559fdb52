#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "tests/support/base/temporary_folder.hpp"
#include "tests/support/programs/program.hpp"

// `astrolabe tags`.
namespace astro {
namespace {

using support::astrolabe;
using support::Outcome;
using testing::HasSubstr;

std::string text_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

class TagsCommand : public testing::Test {
 protected:
  Outcome tags(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words{"tags", "--pdf", pdf()};
    words.insert(words.end(), more.begin(), more.end());
    return astrolabe(words);
  }
  std::string pdf() const { return (folder_.path() / "tags.pdf").string(); }

  test::TemporaryFolder folder_;
};

TEST_F(TagsCommand, WritesInstructionsTheRobotsTagAndSixForTheFloor) {
  const Outcome outcome = tags();
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, pdf() + "\n");
  EXPECT_TRUE(text_of(pdf()).starts_with("%PDF-"));
  EXPECT_THAT(text_of(pdf()), HasSubstr("/Count 8"));
}

TEST_F(TagsCommand, TakesOtherPaperIdsAndSides) {
  EXPECT_EQ(tags({"--paper", "letter", "--floor-ids", "11,12,13", "--robot-side", "90"}).code, 0);
  EXPECT_THAT(text_of(pdf()), HasSubstr("/Count 5"));
}

TEST_F(TagsCommand, ReplacesItsOwnPdfAndNoFileOfAnotherKind) {
  EXPECT_EQ(tags().code, 0);
  EXPECT_EQ(tags().code, 0);
  std::ofstream(pdf()) << "a shopping list";
  EXPECT_THAT(tags().err, HasSubstr("tags.pdf' exists and is no PDF"));
  EXPECT_EQ(text_of(pdf()), "a shopping list");
}

TEST_F(TagsCommand, RefusesIdsThatAreTwiceThereAndSidesThatDoNotFit) {
  struct Case {
    std::vector<std::string> options;
    const char* says;
  };
  for (const Case& each : {Case{{"--floor-ids", "1,2,1"}, "tag 1 would be there twice"},
                           Case{{"--robot-id", "3"}, "tag 3 would be there twice"},
                           Case{{"--floor-ids", "1,587"}, "'587' is not a whole number from 0 to 586"},
                           Case{{"--floor-ids", "1,x"}, "'x' is not a whole number"},
                           Case{{"--floor-side", "169"}, "168 mm is the most"},
                           Case{{"--robot-side", "5"}, "'5' is not a number from 10 to 200 mm"},
                           Case{{"--paper", "a3"}, "a3"}}) {
    const Outcome outcome = tags(each.options);
    EXPECT_EQ(outcome.code, 2);
    EXPECT_THAT(outcome.err, HasSubstr(each.says));
    EXPECT_FALSE(std::filesystem::exists(pdf()));
  }
}

}  // namespace
}  // namespace astro
