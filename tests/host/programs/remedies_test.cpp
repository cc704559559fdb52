#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>
#include <string>
#include <vector>

#include "host/commands/base/remedies.hpp"
#include "tests/support/programs/program.hpp"

/// What a remedy tells a person to do can be done: its commands and options exist.
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

std::vector<std::string> all_remedies() {
  std::vector<std::string> sentences;
  for (std::size_t help = 1; help < kHelps; ++help)
    sentences.push_back(commands::in_words(Remedy{static_cast<Help>(help), "umbmark"}));
  return sentences;
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
  for (const std::string& name : found(commands, R"(\n  ([a-z][a-z-]+) )")) {
    const std::string help = astrolabe({name, "--help"}).out;
    text += help;
    const std::size_t below = help.find("Subcommands:");
    if (below == std::string::npos) continue;
    for (const std::string& sub : found(help.substr(below), R"(\n  ([a-z][a-z-]+) )"))
      text += astrolabe({name, sub, "--help"}).out;
  }
  return text;
}

TEST(Remedies, NameCommandsThatExist) {
  int commands = 0;
  for (const std::string& sentence : all_remedies())
    for (const std::string& command : found(sentence, "['`]astrolabe ([a-z-]+( list| runs)?)")) {
      std::vector<std::string> words = split(command);
      words.emplace_back("--help");
      EXPECT_EQ(astrolabe(words).code, 0) << sentence;
      ++commands;
    }
  EXPECT_GT(commands, 10);
}

TEST(Remedies, NameOptionsThatExist) {
  const std::string help = all_help();
  int options = 0;
  for (const std::string& sentence : all_remedies())
    for (const std::string& option : found(sentence, "(--[a-z-]+)")) {
      EXPECT_THAT(help, testing::HasSubstr(option + " ")) << sentence;
      ++options;
    }
  EXPECT_GT(options, 15);
}

TEST(Remedies, AreWholeClausesBehindTheFact) {
  for (const std::string& sentence : all_remedies()) {
    EXPECT_THAT(sentence, testing::MatchesRegex("(: | \\(|; ).+")) << "joined to the fact";
    EXPECT_THAT(sentence, testing::Not(testing::HasSubstr("{}")));
    EXPECT_FALSE(sentence.ends_with('.')) << sentence;
  }
}

}  // namespace
}  // namespace astro
