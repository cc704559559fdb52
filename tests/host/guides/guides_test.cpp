#include "host/guides/guides.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cctype>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>

#include "tests/host/guides/page.hpp"
#include "tests/host/guides/stage.hpp"
#include "tests/support/base/columns.hpp"
#include "tests/support/base/places.hpp"

// Whoever does what a guide says sees what it shows.
namespace astro::guides {
namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Two squares each way are enough to see what a page shows.
const std::pair<std::string, std::string> kShortDrives{"--out my-experiment --yes",
                                                       "--out my-experiment --yes --runs 2 --side 2"};

const std::vector<Setting>& settings() {
  static const std::vector<Setting> all{
      {.page = "README.md", .absent = {"flash", "check-wiring", "tune", "--truth manual", "friday"}},
      {.page = "host/guides/first-robot.md",
       .absent = {"flash"},
       .instead = {{"vrpn://lab-pc:3883/ASTRO", "sim"}, kShortDrives}},
      {.page = "host/guides/simulator.md", .robot = {}},
      {.page = "host/guides/logs.md", .robot = {}, .files = {"drives"}},
      {.page = "host/guides/ros2.md",
       .tracker = true,
       .instead = {{"--truth ros2:/ASTRO/pose", "--truth sim"}, kShortDrives}},
      {.page = "host/guides/python.md", .instead = {{"python3 ", ASTROLABE_PYTHON " "}}},
      {.page = "host/guides/film.md", .absent = {"drives.mp4", "--truth film"}},
      {.page = "host/guides/tape.md", .absent = {"--truth manual"}},
      {.page = "host/guides/wall.md", .absent = {"--truth wall"}},
      {.page = "host/guides/scanner.md",
       .files = {"scans"},
       .absent = {"/dev/ttyUSB0"},
       .instead = {{"/dev/ttyUSB0", "/nonexistent"}}},
      {.page = "host/guides/gyro.md", .robot = {"--gyro"}},
      {.page = "host/guides/no-motion.md"},
      {.page = "host/guides/odometry-jumps.md", .absent = {"--roll"}},
      {.page = "host/guides/verdict.md", .files = {"experiment"}},
      {.page = "host/guides/link-lost.md"},
      {.page = "host/guides/fault.md"},
      {.page = "host/guides/mathematics.md", .robot = {}},
      {.page = "host/guides/limits.md", .robot = {}},
      {.page = "host/guides/changes.md", .robot = {}},
      {.page = "host/guides/parameters.md", .robot = {}},
  };
  return all;
}

/// Runs until somebody ends it.
bool serves(const std::string& command) {
  for (const char* name : {"astrolabe ros2 ", "astrolabe serve ", "astrolabe monitor "})
    if (command.starts_with(name) && command.find("--count") == command.npos) return true;
  return command.starts_with("astrolabe truth watch ") && command.find("--seconds") == command.npos;
}

/// Programs of a reader's computer that need not be on this one. A word that is on neither list fails the test.
bool is_for_the_reader(const std::string& command) {
  const std::string program = command.substr(0, command.find(' '));
  for (const char* other : {"ros2", "./dev", "git", "export", "sudo", "cd", "apt", "pip"})
    if (program == other) return true;
  return false;
}

bool has_python() {
  return support::Program({"/bin/bash", "-c",
                           "PYTHONPATH='" ASTROLABE_PYTHON_PATH "' " ASTROLABE_PYTHON
                           " -c 'import serial, matplotlib, astrolabe.calibration'"})
             .wait() == 0;
}

class Page : public testing::TestWithParam<Setting> {
 protected:
  static std::vector<std::string> line(const Stage& stage, const std::string& command) {
    const fs::path bin = fs::path(ASTROLABE_PROGRAM).parent_path();
    return {"/bin/bash", "-c",
            // No loader, so that no test ever flashes a board of this computer.
            "export ASTROLABE_LOADER=/bin/false MPLBACKEND=Agg PYTHONPATH='" ASTROLABE_PYTHON_PATH "'; cd '" +
                stage.folder().string() + "' && PATH='" + bin.string() + "':$PATH && exec 2>&1 && " +
                stage.here(command)};
  }
  static support::Program start(const Stage& stage, const std::string& command) {
    return support::Program(line(stage, command));
  }

  static std::string missing(const Stage& stage, const Command& command, const support::Program& program) {
    return missing_line(command.shown, stage.as_on_page(program.out()));
  }

  /// As a shell does with &, but not before it is ready.
  std::unique_ptr<support::Program> begin_beside(const Stage& stage, const std::string& command) {
    auto program = std::make_unique<support::Program>(line(stage, "exec " + command));
    EXPECT_TRUE(support::eventually([&] { return program->out().find("next: ") != std::string::npos; }))
        << program->out();
    return program;
  }

  /// Its options are right, and it stops for want of what is not here.
  void expect_understood(const Stage& stage, const Command& command) {
    support::Program program = start(stage, command.text);
    const int code = program.wait();
    EXPECT_TRUE(code == 0 || code == 1) << program.out();
    EXPECT_THAT(program.out(), testing::Not(testing::HasSubstr("should not have happened")));
    EXPECT_EQ(missing(stage, command, program), "") << program.out();
  }

  void expect_served(const Stage& stage, const Command& command) {
    support::Program program = start(stage, "exec " + command.text);
    EXPECT_TRUE(
        support::eventually([&] { return missing(stage, command, program).empty() || !program.running(); }));
    program.send(SIGTERM);
    EXPECT_EQ(program.wait(), 0) << program.out();
    EXPECT_EQ(missing(stage, command, program), "") << program.out();
  }

  void expect_done(const Stage& stage, const Command& command) {
    support::Program program = start(stage, command.text);
    EXPECT_EQ(program.wait(), 0) << program.out();
    EXPECT_EQ(missing(stage, command, program), "") << stage.as_on_page(program.out());
  }
};

TEST_P(Page, ShowsWhatHappens) {
  const std::string page = text_of(support::checkout() / GetParam().page);
  ASSERT_FALSE(page.empty());
  if (page.find("python3 ") != page.npos && !has_python())
    GTEST_SKIP()
        << "Python's modules are missing: pybind11-dev before the build, python3-serial, python3-matplotlib";
  const Stage stage(GetParam());
  std::vector<std::unique_ptr<support::Program>> beside;  // those that the page starts with &
  for (const Command& command : commands_of(page)) {
    SCOPED_TRACE(GetParam().page + ':' + std::to_string(command.line) + ": " + command.text);
    const auto is_named = [&](const std::string& what) {
      return command.text.find(what) != command.text.npos;
    };
    const std::string program = command.text.substr(0, command.text.find(' '));
    if (is_for_the_reader(command.text)) continue;
    if (!command.is_ours() && program != "printf" && program != "cat" && program != "python3") {
      // Formulas and the like: nothing that anybody could type.
      EXPECT_EQ(GetParam().page, "host/guides/mathematics.md");
      continue;
    }
    if (command.text.ends_with(" &"))
      beside.push_back(begin_beside(stage, command.text.substr(0, command.text.size() - 2)));
    else if (std::ranges::any_of(GetParam().absent, is_named))
      expect_understood(stage, command);
    else if (serves(command.text))
      expect_served(stage, command);
    else
      expect_done(stage, command);
  }
}

std::string name_of(const testing::TestParamInfo<Setting>& info) {
  std::string name = fs::path(info.param.page).stem().string();
  std::erase_if(name, [](unsigned char c) { return std::isalnum(c) == 0; });
  return name;
}

INSTANTIATE_TEST_SUITE_P(Of, Page, testing::ValuesIn(settings()), name_of);

TEST(Pages, AreAllTried) {
  for (const auto& entry : fs::directory_iterator(support::checkout() / "host/guides")) {
    if (entry.path().extension() != ".md" || entry.path().filename() == "README.md") continue;
    const std::string page = "host/guides/" + entry.path().filename().string();
    EXPECT_TRUE(std::ranges::any_of(settings(), [&](const Setting& each) { return each.page == page; }))
        << page;
  }
}

TEST(Pages, AreInTheProgramAndFitATerminal) {
  for (const Guide& guide : all()) {
    EXPECT_EQ(guide.text, text_of(support::checkout() / "host/guides" / (std::string(guide.name) + ".md")));
    const support::Outcome shown = support::astrolabe({"help", std::string(guide.name)});
    EXPECT_EQ(shown.out, guide.text);
    EXPECT_THAT(support::astrolabe({"help"}).out, testing::HasSubstr(std::string(guide.title())));
    EXPECT_LE(support::widest_line(shown.out), 80U) << guide.name;
  }
}

TEST(Pages, NameTopicsThatThereAre) {
  for (const Guide& guide : all()) {
    const std::string text(guide.text);
    for (std::size_t at = 0; (at = text.find("astrolabe help ", at)) != text.npos;) {
      at += std::string("astrolabe help ").size();
      const std::string topic = text.substr(at, text.find_first_of("`\n .", at) - at);
      EXPECT_EQ(support::astrolabe({"help", topic}).code, 0) << guide.name << ": " << topic;
    }
  }
}

TEST(Parameters, HaveAPageThatIsWhatTheTableSays) {
  const std::string page = text_of(support::checkout() / "host/guides/parameters.md");
  EXPECT_LE(support::widest_line(page), 80U);
  EXPECT_EQ(page, support::astrolabe({"help", "parameters"}).out)
      << "run: build/host/bin/astrolabe help parameters > host/guides/parameters.md";
}

TEST(Help, OfACommandIsItsOwn) {
  EXPECT_EQ(support::astrolabe({"help", "umbmark"}).out, support::astrolabe({"umbmark", "--help"}).out);
  EXPECT_EQ(support::astrolabe({"help", "nonsense"}).code, 2);
}

}  // namespace
}  // namespace astro::guides
