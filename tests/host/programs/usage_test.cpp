#include <gmock/gmock.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <set>
#include <sstream>

#include "tests/support/programs/program.hpp"

// What the program says about itself, and about words that it does not know.
namespace astro {
namespace {

using support::astrolabe;
using support::Outcome;
using testing::HasSubstr;
using Words = std::vector<std::string>;

Words with(Words words, const std::string& more) {
  words.push_back(more);
  return words;
}

struct Listed {
  std::string heading, name;
};

// As --help lists them below the options: a heading after an empty line, and on each line two blanks, the name, its description.
std::vector<Listed> commands_in(const std::string& help) {
  std::vector<Listed> commands;
  std::istringstream lines(help);
  std::string line, before, heading;
  for (; std::getline(lines, line); before = line) {
    if (!line.starts_with(' '))
      heading = before.empty() && line.ends_with(':') ? line.substr(0, line.size() - 1) : "";
    const bool listed = line.starts_with("  ") && line.size() > 2 && std::islower(line[2]) != 0;
    if (listed && !heading.empty() && heading != "Positionals" && !heading.starts_with("Example"))
      commands.push_back({heading, line.substr(2, line.find_first_of(" ,", 2) - 2)});
  }
  return commands;
}

std::string joined(const Words& words) {
  std::string text;
  for (const std::string& word : words) text += " " + word;
  return text;
}

int explain(const Words& command) {
  const Outcome outcome = astrolabe(with(command, "--help"));
  EXPECT_EQ(outcome.code, 0) << joined(command);
  EXPECT_EQ(outcome.err, "");
  const std::size_t examples = outcome.out.find("Examples:");
  EXPECT_TRUE(command.empty() || examples != std::string::npos) << joined(command);
  if (!command.empty() && examples != std::string::npos) {
    EXPECT_THAT(outcome.out.substr(examples), HasSubstr("astrolabe" + joined(command)));
  }
  int explained = 1;
  for (const Listed& sub : commands_in(outcome.out)) explained += explain(with(command, sub.name));
  return explained;
}

void fits(const Words& command) {
  const std::string help = astrolabe(with(command, "--help")).out;
  std::istringstream lines(help);
  for (std::string line; std::getline(lines, line);)
    EXPECT_LE(line.size(), 80) << joined(command) << '\n' << line;
  for (const Listed& sub : commands_in(help)) fits(with(command, sub.name));
}

TEST(Help, OfEveryCommandFits80Columns) { fits({}); }

TEST(Help, ListsEveryCommandUnderOneHeading) {
  std::map<std::string, Words> headings;
  std::set<std::string> names;
  for (const Listed& command : commands_in(astrolabe({"--help"}).out)) {
    headings[command.heading].push_back(command.name);
    EXPECT_TRUE(names.insert(command.name).second) << command.name;
  }
  EXPECT_THAT(headings, testing::SizeIs(7));
  EXPECT_THAT(headings, testing::Not(testing::Contains(testing::Key("Subcommands"))));
  EXPECT_THAT(headings["Calibrate"], testing::Contains("umbmark"));
}

TEST(Help, OfEveryCommandShowsExamplesOfIt) {
  EXPECT_GE(explain({}), 1 + 31 + 7 + 8 + 1);  // the program, its commands, those of drive, params and study
}

TEST(Version, IsOneLine) {
  const Outcome outcome = astrolabe({"--version"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_TRUE(outcome.out.starts_with("astrolabe ")) << outcome.out;
}

TEST(Usage, AnErrorBeginsWithTheNameOfTheProgram) {
  const Outcome outcome = astrolabe({"upload", "/nonexistent.toml"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_EQ(outcome.err, "astrolabe: /nonexistent.toml does not exist: check the path\n");
}

struct Mistake {
  Words arguments;
  Words named;
};

class WrongUsage : public testing::TestWithParam<Mistake> {};

TEST_P(WrongUsage, IsOneLineThatNamesTheWordAndExitsWith2) {
  const Outcome outcome = astrolabe(GetParam().arguments);
  EXPECT_EQ(outcome.code, 2) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_TRUE(outcome.err.starts_with("astrolabe: ")) << outcome.err;
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  for (const std::string& word : GetParam().named) EXPECT_THAT(outcome.err, HasSubstr(word));
}

INSTANTIATE_TEST_SUITE_P(
    All, WrongUsage,
    testing::Values(
        Mistake{{}, {"needs a command", "astrolabe --help"}},
        Mistake{{"calibarte"}, {"'astrolabe calibarte'", "did you mean 'calibrate'"}},
        Mistake{{"xyz", "--port", "a"}, {"'astrolabe xyz'"}}, Mistake{{"--foo"}, {"no option '--foo'"}},
        Mistake{{"info", "--ros-args", "-r", "a:=b"}, {"'astrolabe info' has no option '--ros-args'"}},
        Mistake{{"ros2", "--ros-args", "-r", "odom", "--", "--port", "x"}, {"'odom' is not FROM:=TO"}},
        Mistake{{"ros2", "--ros-args", "-p", "publish_rate:=0"}, {"publish_rate", "1 to 1000"}},
        Mistake{{"ros2", "--cmd-vel", "Pose"}, {"'Pose' is none of TwistStamped|Twist|both"}},
        Mistake{{"nonsense", "--help"}, {"no command 'astrolabe nonsense'", "'astrolabe --help' explains"}},
        Mistake{{"drive", "lin", "--help"}, {"no command 'astrolabe drive lin'", "did you mean 'line'"}},
        Mistake{{"drive"}, {"'astrolabe drive' needs a command", "astrolabe drive --help"}},
        Mistake{{"drive", "lin", "1"}, {"'astrolabe drive lin'", "did you mean 'line'"}},
        Mistake{{"drive", "line"}, {"LENGTH is required", "astrolabe drive line --help"}},
        Mistake{{"drive", "line", "1", "2"}, {"no place for '2'"}},
        Mistake{{"drive", "line", "1", "--sped", "2"}, {"no option '--sped'", "did you mean '--speed'"}},
        Mistake{{"drive", "line", "one"}, {"'one' is not a number"}},
        Mistake{{"drive", "line", "nan"}, {"'nan' is not a number"}},
        Mistake{{"drive", "spin", "1e999"}, {"'1e999' is not a number"}},
        Mistake{{"drive", "line", "1", "--speed", "0"}, {"--speed", "'0' is not a number from"}},
        Mistake{{"drive", "square", "-1"}, {"'-1' is not a number above 0"}},
        Mistake{{"drive", "square", "1", "--cw", "--ccw"}, {"excludes"}},
        Mistake{{"drive", "velocity", "1", "1"}, {"--for is required"}},
        Mistake{{"info", "--port"}, {"--port needs a value"}},
        Mistake{{"info", "--baud", "fast"}, {"--baud", "'fast' is not a whole number"}},
        Mistake{{"monitor", "--count", "0"}, {"--count", "'0' is not a whole number"}},
        Mistake{{"monitor", "--rate", "-3"}, {"--rate", "'-3' is not a number from"}},
        Mistake{{"params", "set"}, {"is required", "astrolabe params set --help"}},
        Mistake{{"tune", "--bandwidth", "fast"}, {"--bandwidth", "'fast' is not a bandwidth"}},
        Mistake{{"tune", "--bandwidth", "-3Hz"}, {"'-3Hz' is not a bandwidth"}},
        Mistake{{"tune", "--on-stand", "--on-ground"}, {"excludes"}},
        Mistake{{"tune", "--max-voltage", "0"}, {"--max-voltage", "'0' is not a number from"}},
        Mistake{{"tune", "--max-distance", "nan"}, {"--max-distance", "'nan'"}},
        Mistake{{"tune"}, {"--on-stand", "--on-ground"}},
        Mistake{{"check-wiring", "--saw-left", "up"}, {"--saw-left", "'up' is none of left-forward"}},
        Mistake{{"check-wiring", "--saw-left", "lf"}, {"--saw-right"}},
        Mistake{{"check-wiring", "--rolled-turns", "10"}, {"--roll"}},
        Mistake{{"check-wiring", "--roll", "--rolled-turns", "0"}, {"'0' is not a number above 0"}},
        Mistake{{"plan", "--until", "5"}, {"--until", "'5' is no precision"}},
        Mistake{{"plan", "--until", "0.05%", "--squares", "4"}, {"--until", "--squares"}},
        Mistake{{"plan", "--kinds", "squares"}, {"--kinds", "--until"}},
        Mistake{{"plan", "--until", "1%", "--kinds", "rings"}, {"'rings' is none of"}},
        Mistake{{"record", "--out", "x", "--lines", "0"}, {"no runs to drive"}},
        Mistake{{"record", "--out", "x", "--lines", "1", "--seconds", "3"}, {"--seconds"}},
        Mistake{{"record", "--out", "x", "--pause"}, {"--pause"}},
        Mistake{{"plan", "--squares", "1001"}, {"'1001' is not a whole number"}},
        Mistake{{"record", "--out", "x", "--seconds", "0"}, {"--seconds", "'0' is not a number above 0"}},
        Mistake{{"calibrate", "runs", "x", "--method", "ml", "--angles", "x"},
                {"--angles is of --method umbmark", "--method ml"}},
        Mistake{{"calibrate", "runs", "x", "--formula", "exact"}, {"--formula", "--method extended"}},
        Mistake{{"umbmark", "--truth", "sim", "--out", "x", "--method", "ml", "--angles", "x"}, {"--angles"}},
        Mistake{{"umbmark", "--truth", "sim", "--out", "x", "--truth-folder", "y"},
                {"--truth-folder", "sim"}},
        Mistake{{"study", "--shard", "4/3"}, {"--shard", "'4/3' is no shard"}},
        Mistake{{"study", "--shard", "1/2"}, {"--out"}},
        Mistake{{"study", "--shard", "1/2", "--out", "x", "--json"}, {"--json", "study merge"}},
        Mistake{{"study", "--clock", "guessed"}, {"--clock"}},
        Mistake{{"calibrate", "export", "x", "--to", "y.yaml", "--wheel-radius", "36"},
                {"--wheel-radius", "'36' is not a number from 0.002 to 2 m"}},
        Mistake{{"calibrate", "export", "x", "--to", "y.yaml", "--wheel-separation", "300"},
                {"--wheel-separation", "0.01 to 10 m"}},
        Mistake{{"calibrate", "export", "x", "--to", "y.yaml", "--node", "my node"},
                {"--node", "'my node' is no name of a node"}},
        Mistake{{"study", "--trials", "0"}, {"'0' is not a whole number"}},
        Mistake{{"study", "--trials", "1"}, {"'1' is not a whole number from 2"}},
        Mistake{{"study", "mege"}, {"'astrolabe study mege'", "did you mean 'merge'"}},
        Mistake{{"study", "merge"}, {"FILES is required"}},
        Mistake{{"sim", "--wiring", "left"}, {"--wiring", "'left' is not a wiring fault"}},
        Mistake{{"sim", "--slip", "-1e-6"}, {"--slip", "'-1e-6' is not a number from"}},
        Mistake{{"sim", "--true-wheelbase", "0"}, {"--true-wheelbase", "'0' is not a number from"}},
        Mistake{{"sim", "--true-wheelbase", "nan"}, {"--true-wheelbase", "'nan'"}},
        Mistake{{"sim", "--true-ed", "inf"}, {"--true-ed", "'inf'"}},
        Mistake{{"sim", "--scale", "-1"}, {"--scale", "'-1'"}},
        Mistake{{"sim", "--seed", "-1"}, {"--seed", "'-1' is not a whole number"}},
        Mistake{{"sim", "--seed", "18446744073709551616"}, {"--seed", "not a whole number"}}));

struct BadPath {
  Words options;
  std::string named;
};

class SimulatorPaths : public testing::TestWithParam<BadPath> {};

TEST_P(SimulatorPaths, ThatCannotBeAreNamedInOneSentence) {
  Words arguments{"sim"};
  arguments.insert(arguments.end(), GetParam().options.begin(), GetParam().options.end());
  const Outcome outcome = astrolabe(arguments);
  EXPECT_EQ(outcome.code, 1);
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr(GetParam().named));
}

INSTANTIATE_TEST_SUITE_P(All, SimulatorPaths,
                         testing::Values(BadPath{{"--pty", "/no/such/folder/astro"}, "/no/such/folder/astro"},
                                         BadPath{{"--pty", "/etc/passwd"}, "'/etc/passwd' exists"},
                                         BadPath{{"--pty", "/tmp"}, "'/tmp' exists"},
                                         BadPath{{"--flash", "/no/such/folder/flash"}, "'/no/such/folder'"},
                                         BadPath{{"--flash", "/tmp"}, "'/tmp' is not a file"},
                                         BadPath{{"--flash", "/etc/passwd"}, "bytes"},
                                         BadPath{{"--pty", "/tmp/" + std::string(200, 'x')}, "too long"}));

TEST(Usage, WhatIsPrintedOntoAFullDiskIsAnError) {
  // Each of these prints in a different way: tables, CLI11's own output, and JSON.
  for (const char* command : {"plan --squares 5", "--help", "study --trials 2 --runs 1 --json"}) {
    support::Program program(
        {"/bin/sh", "-c", std::string(ASTROLABE_PROGRAM) + " " + command + " > /dev/full"});
    EXPECT_EQ(program.wait(), 1) << command;
    EXPECT_THAT(program.err(), HasSubstr("cannot be written")) << command;
  }
}

}  // namespace
}  // namespace astro
