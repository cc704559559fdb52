#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>
#include <string>
#include <vector>

#include "host/commands/base/advice.hpp"
#include "host/console/program.hpp"
#include "host/programs/astrolabe/all_commands.hpp"
#include "tests/support/programs/program.hpp"

/// What a person is advised to do can be done: the commands and options exist.
namespace astro {
namespace {

using support::astrolabe;

std::vector<std::string> found(const std::string& text, const std::string& pattern) {
  std::vector<std::string> words;
  const std::regex expression(pattern);
  for (std::sregex_iterator at(text.begin(), text.end(), expression), end; at != end; ++at)
    words.push_back((*at)[1]);
  return words;
}

/// What every command advises, behind an empty sentence.
std::vector<std::string> all_words() {
  console::Program program("astrolabe", "");
  commands::add_all(program.command());
  std::vector<std::string> words;
  for (const commands::Advice& advice : commands::all_advice())
    words.push_back(commands::in_words(Remark{"", advice.kind, {"umbmark"}}));
  return words;
}

std::vector<std::string> split(const std::string& words) {
  std::istringstream stream(words);
  std::vector<std::string> list;
  for (std::string word; stream >> word;) list.push_back(word);
  return list;
}

/// The help of every command that has some, one after the other.
std::string all_help() {
  std::string text;
  const std::string commands = astrolabe({"--help"}).out;
  for (const std::string& name : found(commands, R"(\n  ([a-z][a-z-]+)[ ,])")) {
    const std::string help = astrolabe({name, "--help"}).out;
    text += help;
    const std::size_t below = help.find("Subcommands:");
    if (below == std::string::npos) continue;
    for (const std::string& sub : found(help.substr(below), R"(\n  ([a-z][a-z-]+) )"))
      text += astrolabe({name, sub, "--help"}).out;
  }
  return text;
}

TEST(Advice, NamesCommandsThatExist) {
  int commands = 0;
  for (const std::string& sentence : all_words())
    for (const std::string& command : found(sentence, "['`]astrolabe ([a-z-]+( list| runs)?)")) {
      std::vector<std::string> words = split(command);
      words.emplace_back("--help");
      EXPECT_EQ(astrolabe(words).code, 0) << sentence;
      ++commands;
    }
  EXPECT_GT(commands, 10);
}

TEST(Advice, NamesOptionsThatExist) {
  const std::string help = all_help();
  int options = 0;
  for (const std::string& sentence : all_words())
    for (const std::string& option : found(sentence, "(--[a-z-]+)")) {
      EXPECT_THAT(help, testing::HasSubstr(option + " ")) << sentence;
      ++options;
    }
  EXPECT_GT(options, 15);
}

TEST(Advice, IsOneForEachKind) {
  all_words();
  const std::vector<commands::Advice> all = commands::all_advice();
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) EXPECT_FALSE(all[i].kind == all[k].kind) << all[i].words;
}

TEST(Advice, IsAWholeClauseBehindTheSentence) {
  for (const std::string& sentence : all_words()) {
    EXPECT_THAT(sentence, testing::MatchesRegex("(: | \\(|; ).+")) << "joined to the sentence";
    EXPECT_THAT(sentence, testing::Not(testing::HasSubstr("{}")));
    EXPECT_FALSE(sentence.ends_with('.')) << sentence;
  }
}

}  // namespace
}  // namespace astro
