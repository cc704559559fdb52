#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>

#include "tests/support/base/temporary_folder.hpp"
#include "tests/support/programs/program.hpp"

// What the program gives a shell and man: every command and option is theirs, because both are made of the command line itself.
namespace astro {
namespace {

using support::astrolabe;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsSupersetOf;
using Words = std::vector<std::string>;

/// What bash offers for a command line, of which the last word is being typed.
Words offered_by_bash(const Words& typed) {
  std::string line;
  for (const std::string& word : typed) line += " '" + word + "'";
  const std::string program = ASTROLABE_PROGRAM;
  support::Program bash({"/bin/bash", "-c",
                         "source <('" + program + "' completion bash); COMP_WORDS=('" + program + "'" + line +
                             "); COMP_CWORD=" + std::to_string(typed.size()) +
                             R"(; _astrolabe; printf '%s\n' "${COMPREPLY[@]}")"});
  EXPECT_EQ(bash.wait(), 0) << bash.err();
  std::istringstream lines(bash.out());
  Words words;
  for (std::string word; std::getline(lines, word);)
    if (!word.empty()) words.push_back(word);
  return words;
}

TEST(Bash, CompletesCommandsOptionsAndTheirWords) {
  EXPECT_THAT(offered_by_bash({"cali"}), ElementsAre("calibrate"));
  EXPECT_THAT(offered_by_bash({"calibrate", ""}), IsSupersetOf({"files", "runs", "bag"}));
  EXPECT_THAT(offered_by_bash({"umbmark", "--or"}), ElementsAre("--order"));
  EXPECT_THAT(offered_by_bash({"umbmark", "--order", "cw"}), ElementsAre("cw-first"));
}

TEST(Bash, CompletesBehindAnEqualsSignWhichItTakesForAWord) {
  EXPECT_THAT(offered_by_bash({"umbmark", "--order", "=", "cw"}), ElementsAre("cw-first"));
  EXPECT_THAT(offered_by_bash({"umbmark", "--order", "="}), IsSupersetOf({"cw-first", "ccw-first"}));
  const test::TemporaryFolder folder;
  std::ofstream(folder.path() / "robot.toml") << "b = 0.29\n";
  EXPECT_THAT(offered_by_bash({"calibrate", "bag", "--robot", "=", (folder.path() / "rob").string()}),
              ElementsAre((folder.path() / "robot.toml").string()));
}

TEST(Bash, CompletesNamesOfFilesWithBlanks) {
  const test::TemporaryFolder folder;
  std::ofstream(folder.path() / "my drive.csv") << "t\n";
  EXPECT_THAT(offered_by_bash({"inspect", (folder.path() / "my").string()}),
              ElementsAre((folder.path() / "my drive.csv").string()));
}

std::string text_of(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

TEST(Manual, HasAPageForEachCommandWithAllItsOptions) {
  const test::TemporaryFolder folder;
  ASSERT_EQ(astrolabe({"manual", folder.path().string()}).code, 0);
  for (const Words& command :
       {Words{}, {"umbmark"}, {"calibrate"}, {"calibrate", "files"}, {"params", "set"}}) {
    std::string name = "astrolabe";
    for (const std::string& word : command) name += "-" + word;
    std::string text = text_of(folder.path() / (name + ".1"));
    EXPECT_TRUE(text.starts_with(".TH \"ASTROLABE")) << name;
    text = std::regex_replace(text, std::regex(R"(\\-)"), "-");
    Words words = command;
    words.emplace_back("--help");
    const std::string help = astrolabe(words).out;
    const std::regex option("--[a-z-]+");
    for (std::sregex_iterator found(help.begin(), help.end(), option), end; found != end; ++found)
      EXPECT_THAT(text, HasSubstr(found->str())) << name;
  }
}

// A line of text that begins with a dot or a quote would be a request to man, and vanish.
TEST(Manual, LosesNoLineOfTheHelp) {
  const test::TemporaryFolder folder;
  ASSERT_EQ(astrolabe({"manual", folder.path().string()}).code, 0);
  int pages = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
    std::istringstream lines(text_of(entry.path()));
    for (std::string line; std::getline(lines, line);)
      EXPECT_TRUE(std::regex_search(line, std::regex(R"(^([^.']|\.(TH|SH|SS|TP|B|BR|nf|fi)( |$)|$))")))
          << entry.path() << ": " << line;
    ++pages;
  }
  EXPECT_GT(pages, 28 + 15) << "the commands and those below them";
}

TEST(Installation, PutsWhatIsOursWhereDebianLooksForItAndTouchesNothingElse) {
  const test::TemporaryFolder folder;
  const std::filesystem::path share = folder.path() / "usr/local/share";
  std::filesystem::create_directories(share / "man/man1");
  std::ofstream(share / "man/man1/other.1") << ".TH OTHER 1\n";
  const std::filesystem::path build = std::filesystem::path(ASTROLABE_PROGRAM).parent_path().parent_path();
  support::Program install({"/bin/sh", "-c",
                            "DESTDIR='" + folder.path().string() + "' cmake --install '" + build.string() +
                                "' --prefix /usr/local"});
  ASSERT_EQ(install.wait(), 0) << install.err();
  EXPECT_EQ(text_of(share / "man/man1/other.1"), ".TH OTHER 1\n");
  for (const char* file :
       {"bash-completion/completions/astrolabe", "zsh/vendor-completions/_astrolabe",
        "fish/vendor_completions.d/astrolabe.fish", "man/man1/astrolabe.1.gz",
        "man/man1/astrolabe-calibrate-files.1.gz", "man/man1/astrolabe-help-first-robot.1.gz",
        "doc/astrolabe/changelog.gz", "doc/astrolabe/copyright"})
    EXPECT_TRUE(std::filesystem::is_regular_file(share / file)) << file;
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "usr/local/bin/astrolabe"));
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "usr/local/lib/udev/rules.d/60-astrolabe.rules"));
}

}  // namespace
}  // namespace astro
