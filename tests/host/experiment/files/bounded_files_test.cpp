#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <vector>

#include "host/base/file_problem.hpp"
#include "host/base/files.hpp"
#include "host/base/folder_lock.hpp"
#include "host/experiment/analysis/calibration_file.hpp"
#include "host/experiment/files/journal.hpp"
#include "host/experiment/files/toml_file.hpp"
#include "tests/support/base/bounded.hpp"
#include "tests/support/base/remarks.hpp"
#include "tests/support/base/thorough.hpp"
#include "tests/support/robots/desk.hpp"

// Files beside recordings that nobody has written: refused within the bar of bounded.hpp, by their name. Why
// they are refused is asserted in the measured child, which otherwise does not end well (Taken::ended).
namespace astro::experiment {
namespace {

namespace fs = std::filesystem;
using support::Desk;
using support::measured;
using support::Taken;
using support::Tells;
using support::TemporaryFolder;
using support::ThrowsTelling;

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
  template <class... Values>
  void refuses_parameters(const std::string& text, Kind kind, Values... values) const {
    const fs::path path = file("x.toml", text);
    const Taken taken = measured([&] {
      EXPECT_THAT([&] { read_parameter_file(path); }, ThrowsTelling(kind, path.string(), values...));
    });
    EXPECT_BOUNDED(taken, text.size());
  }
  void refuses_depth(const std::string& text, const std::string& line) const {
    refuses_parameters(text, TomlProblem::nests_too_deeply, line);
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
  /// For a reason with these values; an empty one is not compared.
  void refuses_journal(const std::string& text, Kind kind,
                       const std::vector<std::string>& reason = {}) const {
    const fs::path path = file("experiment.json", text);
    const Taken taken = measured([&] {
      const Remark told = support::told_by([&] { read_journal(folder_.path()); });
      EXPECT_THAT(told, Tells(kind));
      ASSERT_FALSE(told.values.empty());
      EXPECT_EQ(told.values.front(), path.string());
      if (reason.empty()) return;
      EXPECT_EQ(std::vector(told.values.begin() + 1, told.values.end()), reason);
    });
    EXPECT_BOUNDED(taken, text.size());
  }
  void is_damaged(const std::string& text, const std::vector<std::string>& reason = {}) const {
    refuses_journal(text, JournalProblem::damaged, reason);
  }

  TemporaryFolder folder_;
};

TEST_F(BoundedFiles, TomlThatNestsSixtyThousandLevelsDeepIsRefusedByItsLine) {
  const std::string deep = "a" + repeated(".a", 60'000);
  refuses_depth("x = 1\n" + deep + " = 1\n", "2");
  refuses_depth("[" + deep + "]\nx = 1\n", "1");
  refuses_depth("[[" + deep + "]]\nx = 1\n", "1");
  refuses_depth("'a'" + repeated(" . \"a\"", 60'000) + " = 1\n", "1");
  refuses_depth("x = " + repeated("[", 60'000), "1");
  refuses_depth("x = " + repeated("{ a.a.a.a.a.a.a.a = ", 30'000), "1");
  refuses_depth(repeated("\n", 70'000) + deep + " = 1", "70001");
}

TEST_F(BoundedFiles, TomlCannotHideItsDepthInTexts) {
  const std::string deep = "{ a" + repeated(".a", 60'000) + " = 1 }";
  refuses_depth("x = [ \"#\\\"\", " + deep + " ]", "1");
  refuses_depth("x = [ '#\\', " + deep + " ]", "1");
  refuses_depth("x = [ \"\"\"a\n\"b\"\"\"\", " + deep + " ]", "2");
  refuses_depth("x = [ '''a\n#'''', " + deep + " ]", "2");
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
  refuses_parameters(text + text + text, FileProblem::too_large, std::to_string(3 * text.size()),
                     std::to_string(kMaxSettingsBytes));
}

TEST_F(BoundedFiles, JournalWithCountsThatNobodyDrivesIsDamaged) {
  const std::vector<std::string> counts = {"1e999",  "\"5\"",      "2147483647", "1e300",
                                           "-1e300", "4294967301", "2.5",        "true"};
  for (int i = 0; i < support::how_many_alike(static_cast<int>(counts.size())); ++i)
    for (const std::string key : {"runs", "rounds", "most"}) {
      SCOPED_TRACE(key + " = " + counts[i]);
      is_damaged(journal_with(key, counts[i]));
    }
  is_damaged(journal_with("runs", "1000000000"), {"runs", "1000000000"});
  is_damaged(journal_with("rounds", "2147483647"), {"rounds", "2147483647"});
  is_damaged(journal_with("most", "1e300"), {"most", "1e+300"});
  is_damaged(journal_with("runs", "-1"), {"runs", "-1"});
  for (const std::string key : {"side_m", "speed_mps", "yaw_rate_radps", "line_m", "circle_radius_m"})
    is_damaged(journal_with(key, "1e300"), {key, "1e+300"});
}

TEST_F(BoundedFiles, JournalOfFiftyMegabytesIsRefusedUnread) {
  const std::string large = "[" + repeated("[],", 17'000'000);
  refuses_journal(large, FileProblem::too_large,
                  {std::to_string(large.size()), std::to_string(kMaxSettingsBytes)});
  is_damaged(repeated("[", 1'000'000));
  is_damaged("[" + repeated("[],", 300'000));
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
  Remark told;
  hooks.run_started = [&](const RunSpec& spec, int, int) {
    if (spec.phase != "before" || spec.direction != Sense::cw) return;
    told = support::told_by([&] { run_experiment(second.client, second.truth, plan, folder_.path(), {}); });
  };
  run_experiment(first.client, first.truth, plan, folder_.path(), hooks);
  EXPECT_THAT(told, Tells(FileProblem::folder_in_use, folder_.path().string()));
}

}  // namespace
}  // namespace astro::experiment
