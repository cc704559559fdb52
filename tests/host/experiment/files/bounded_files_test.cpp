#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "host/base/error.hpp"
#include "host/experiment/analysis/calibration_file.hpp"
#include "host/experiment/files/journal.hpp"
#include "tests/support/base/bounded.hpp"
#include "tests/support/robots/desk.hpp"

// Files beside recordings that nobody has written: refused within the bar of bounded.hpp, by their name.
namespace astro::experiment {
namespace {

namespace fs = std::filesystem;
using support::Desk;
using support::measured;
using support::Taken;
using support::TemporaryFolder;
using testing::HasSubstr;

std::string repeated(const std::string& text, std::size_t count) {
  std::string all;
  for (std::size_t i = 0; i < count; ++i) all += text;
  return all;
}

class BoundedFiles : public testing::Test {
 protected:
  fs::path file(const std::string& name, const std::string& text) const {
    std::ofstream(folder_.path() / name, std::ios::binary) << text;
    return folder_.path() / name;
  }
  void refuses_parameters(const std::string& text, const std::string& reason) const {
    const fs::path path = file("x.toml", text);
    const Taken taken = measured([&] { read_parameter_file(path); });
    EXPECT_BOUNDED(taken, text.size());
    EXPECT_THAT(taken.complaint, HasSubstr("x.toml"));
    EXPECT_THAT(taken.complaint, HasSubstr(reason));
  }
  /// experiment.json of a small experiment in which the value of `key` is another.
  std::string journal_with(const std::string& key, const std::string& value) const {
    Journal journal;
    journal.plan.truth = "sim";
    journal.plan.until = Until{0.001, 5};
    write_journal(folder_.path(), journal);
    std::ifstream written(folder_.path() / "experiment.json");
    std::string text(std::istreambuf_iterator<char>(written), {});
    const std::size_t at = text.find("\"" + key + "\": ");
    EXPECT_NE(at, std::string::npos);
    const std::size_t from = at + key.size() + 4;
    return text.replace(from, text.find_first_of(",\n", from) - from, value);
  }
  void refuses_journal(const std::string& text, const std::string& reason) const {
    file("experiment.json", text);
    const Taken taken = measured([&] { read_journal(folder_.path()); });
    EXPECT_BOUNDED(taken, text.size());
    EXPECT_THAT(taken.complaint, HasSubstr("experiment.json"));
    EXPECT_THAT(taken.complaint, HasSubstr(reason));
  }

  TemporaryFolder folder_;
};

TEST_F(BoundedFiles, TomlThatNestsSixtyThousandLevelsDeepIsRefusedByItsLine) {
  const std::string deep = "a" + repeated(".a", 60'000);
  refuses_parameters("x = 1\n" + deep + " = 1\n", "line 2 nests more than 16 levels deep");
  refuses_parameters("[" + deep + "]\nx = 1\n", "line 1 nests");
  refuses_parameters("[[" + deep + "]]\nx = 1\n", "line 1 nests");
  refuses_parameters("'a'" + repeated(" . \"a\"", 60'000) + " = 1\n", "line 1 nests");
  refuses_parameters("x = " + repeated("[", 60'000), "line 1 nests");
  refuses_parameters("x = " + repeated("{ a.a.a.a.a.a.a.a = ", 30'000), "line 1 nests");
  refuses_parameters(repeated("\n", 70'000) + deep + " = 1", "line 70001 nests");
}

TEST_F(BoundedFiles, TomlCannotHideItsDepthInTexts) {
  const std::string deep = "{ a" + repeated(".a", 60'000) + " = 1 }";
  refuses_parameters("x = [ \"#\\\"\", " + deep + " ]", "nests");
  refuses_parameters("x = [ '#\\', " + deep + " ]", "nests");
  refuses_parameters("x = [ \"\"\"a\n\"b\"\"\"\", " + deep + " ]", "nests");
  refuses_parameters("x = [ '''a\n#'''', " + deep + " ]", "nests");
}

TEST_F(BoundedFiles, TomlMayHaveAnyNumberOfDotsInTextsAndComments) {
  const std::string dots = repeated(".", 100);
  const fs::path path =
      file("x.toml", "# a" + dots + " = 1 [[[[[[[[[[[[[[[[[[[\n[parameters]\nx = \"" + dots + "\\\"" + dots +
                         "\"\ny = '''\n" + dots + "'''\nz = '" + dots + "'\n");
  EXPECT_EQ(read_parameter_file(path).parameters.size(), 3U);
}

TEST_F(BoundedFiles, TomlOfManyShortValuesStaysWithinTheBarOrIsTooLarge) {
  std::string text = "[parameters]\n";
  for (int i = 0; text.size() < 1'000'000; ++i) text += "a" + std::to_string(i) + "=1\n";
  const fs::path path = file("x.toml", text);
  const Taken taken = measured([&] { read_parameter_file(path); });
  EXPECT_BOUNDED(taken, text.size());
  refuses_parameters(text + text + text, "no file of its kind has more than 1");
}

TEST_F(BoundedFiles, JournalWithCountsThatNobodyDrivesIsDamaged) {
  for (const std::string count :
       {"2147483647", "1e300", "-1e300", "4294967301", "1e999", "2.5", "true", "\"5\""})
    for (const std::string key : {"runs", "rounds", "most"}) {
      SCOPED_TRACE(key + " = " + count);
      refuses_journal(journal_with(key, count), "is damaged");
    }
  refuses_journal(journal_with("runs", "1000000000"), "is damaged (1000000000 runs in each direction");
  refuses_journal(journal_with("rounds", "2147483647"), "is damaged (2147483647 rounds");
  refuses_journal(journal_with("most", "1e300"), "is damaged (most is 1e+300, not a whole number");
  refuses_journal(journal_with("runs", "-1"), "is damaged (runs is -1, not a whole number");
  for (const std::string key : {"side_m", "speed_mps", "yaw_rate_radps", "line_m", "circle_radius_m"})
    refuses_journal(journal_with(key, "1e300"), "is damaged (a ");
}

TEST_F(BoundedFiles, JournalOfFiftyMegabytesIsRefusedUnread) {
  refuses_journal("[" + repeated("[],", 17'000'000), "no file of its kind has more than 1");
  refuses_journal(repeated("[", 1'000'000), "is damaged");
  refuses_journal("[" + repeated("[],", 300'000), "is damaged");
}

TEST_F(BoundedFiles, JournalTakesTextsOfARobotThatAreNoUtf8) {
  Journal journal;
  journal.plan.truth = "sim";
  journal.board = "\xFF\033[2J";
  write_journal(folder_.path(), journal);
  EXPECT_EQ(read_journal(folder_.path()).board, "\xEF\xBF\xBD\033[2J");
}

TEST_F(BoundedFiles, TwoExperimentsInOneFolderAreLockedApart) {
  Desk first{sim::Config{}}, second{sim::Config{}};
  Plan plan;
  plan.runs = 1;
  plan.side_m = 1;
  plan.extras = false;
  plan.truth = "sim";
  ExperimentHooks hooks;
  std::string complaint;
  hooks.run_started = [&](const RunSpec&, int, int) {
    if (!complaint.empty()) return;
    try {
      run_experiment(second.client, second.truth, plan, folder_.path(), {});
    } catch (const Error& error) {
      complaint = error.what();
    }
  };
  run_experiment(first.client, first.truth, plan, folder_.path(), hooks);
  EXPECT_EQ(complaint, "another program records into '" + folder_.path().string() + "'");
}

}  // namespace
}  // namespace astro::experiment
