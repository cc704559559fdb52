#include "host/console/completion.hpp"

#include <gmock/gmock.h>

#include "host/console/program.hpp"

// What may follow on a command line that somebody is typing.
namespace astro::console {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::IsEmpty;
using Words = std::vector<std::string>;

class TypedLine : public testing::Test {
 protected:
  TypedLine() {
    const Command app = program_.command();
    app.under("Drive", [&] {
      const Command drive = app.add_subcommand("drive", "drive a path; stops at its end");
      drive.add_option("--port,-p", text_, "serial port");
      drive.add_option("--order", text_, "which way first").one_of({"cw", "ccw"});
      drive.add_flag("--json", given_, "as JSON");
      drive.add_subcommand("line", "a line");
      drive.add_subcommand("square", "a square");
      app.add_subcommand("report", "write\na report").add_option("folder", folder_, "of the experiment");
    });
    app.under("", [&] { app.add_subcommand("secret", "for scripts"); });
  }

  Completion after(const Words& typed) { return complete(program_.command(), typed); }
  Words words(const Words& typed) {
    Words out;
    for (const Completion::Word& each : after(typed).words) out.push_back(each.word);
    return out;
  }

 private:
  Program program_{"toy", "a program"};
  std::string text_;
  std::filesystem::path folder_;
  bool given_ = false;
};

TEST_F(TypedLine, AtItsBeginningTakesEveryCommandThatIsNotHidden) {
  EXPECT_THAT(words({""}), ElementsAre("drive", "report"));
  EXPECT_THAT(words({}), ElementsAre("drive", "report"));
}

TEST_F(TypedLine, GetsWhatACommandIsForInOneLine) {
  EXPECT_THAT(after({"d"}).words, ElementsAre(Completion::Word{"drive", "drive a path"}));
  EXPECT_THAT(after({"r"}).words, ElementsAre(Completion::Word{"report", "write a report"}));
}

TEST_F(TypedLine, GoesOnWithTheCommandsBelowOne) {
  EXPECT_THAT(words({"drive", ""}), ElementsAre("line", "square"));
  EXPECT_THAT(words({"drive", "s"}), ElementsAre("square"));
  EXPECT_THAT(words({"drive", "--json", "--port", "line", "s"}), ElementsAre("square"))
      << "'line' is the port's name here";
}

TEST_F(TypedLine, OffersOptionsOnceADashStands) {
  EXPECT_THAT(words({"drive", "-"}), ElementsAre("--help", "--port", "--order", "--json"));
  EXPECT_THAT(words({"drive", "--j"}), ElementsAre("--json"));
}

TEST_F(TypedLine, OffersTheWordsThatAnOptionAccepts) {
  EXPECT_THAT(words({"drive", "--order", ""}), ElementsAre("cw", "ccw"));
  EXPECT_THAT(words({"drive", "--order", "cc"}), ElementsAre("ccw"));
  EXPECT_FALSE(after({"drive", "--order", ""}).files);
}

TEST_F(TypedLine, OffersTheWordsOfAnOptionAlsoBehindAnEqualsSign) {
  EXPECT_THAT(words({"drive", "--order="}), ElementsAre("--order=cw", "--order=ccw"));
  EXPECT_THAT(words({"drive", "--order=cc"}), ElementsAre("--order=ccw"));
  EXPECT_TRUE(after({"drive", "--port=/dev/"}).files);
  EXPECT_FALSE(after({"drive", "--json="}).files) << "a flag takes no value";
}

TEST_F(TypedLine, OffersFilesWhereAnyWordMayStand) {
  EXPECT_TRUE(after({"drive", "--port", "/dev/"}).files);
  EXPECT_TRUE(after({"report", ""}).files);
  EXPECT_FALSE(after({"drive", ""}).files);
  EXPECT_THAT(words({"report", ""}), IsEmpty());
}

TEST_F(TypedLine, IsNotEndedByAWordThatNobodyKnows) {
  EXPECT_THAT(words({"drive", "--nonsense", "l"}), ElementsAre("line"));
  EXPECT_THAT(words({"nonsense", "d"}), ElementsAre("drive"));
}

}  // namespace
}  // namespace astro::console
