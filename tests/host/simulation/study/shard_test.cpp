#include "host/simulation/study/shard_file.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "host/base/text/number_problem.hpp"
#include "host/base/text/numbers.hpp"
#include "host/simulation/study/limits.hpp"
#include "host/simulation/study/study.hpp"
#include "tests/support/base/bounded.hpp"
#include "tests/support/base/remarks.hpp"

namespace astro::simulation::study {
namespace {

using support::Tells;
using support::told_by;

TEST(Shard, EachTrialIsInExactlyOne) {
  for (const int trials : {1, 7, 200, 1000003})
    for (const int of : {1, 2, 3, 8, 200}) {
      int next = 0;
      for (int number = 1; number <= of; ++number) {
        const Shard shard{number, of};
        EXPECT_EQ(shard.begin(trials), next);
        EXPECT_GE(shard.end(trials), next);
        next = shard.end(trials);
      }
      EXPECT_EQ(next, trials);
    }
}

// Trials without driving: figures of awkward digits, and one failure.
std::vector<Trial> some_trials(int begin, int end) {
  std::vector<Trial> trials;
  for (int i = begin; i < end; ++i) {
    Trial trial;
    trial.index = i;
    for (std::size_t m = 0; m < kMethods.size(); ++m) {
      Errors errors;
      for (std::size_t f = 0; f < kFigures; ++f)
        errors[f] = 1.0 / (3.0 + i + static_cast<double>(m) * 0.1 + static_cast<double>(f));
      trial.errors[m] = errors;
    }
    trial.ml_chi_square = std::numeric_limits<double>::denorm_min() * (i + 1);
    trial.ml_unknowns = 3 + i % 2;
    trial.ml_K_m = 1e-6 / (3.0 + i);
    trials.push_back(trial);
  }
  trials.front().errors[kMl].reset();
  trials.front().ml_chi_square.reset();
  trials.front().ml_K_m.reset();
  trials.front().failure = "ml: \"quoted\", and\nbroken";
  return trials;
}

TrialSetup of_trials(int trials) {
  TrialSetup setup;
  setup.trials = trials;
  setup.seed = std::numeric_limits<std::uint64_t>::max();
  setup.circles = 2;
  setup.circle_radius_m = 1.0 / 3;
  setup.e = 1.0 / 70;
  setup.windup_rad = 0.006 / 7;
  return setup;
}

ShardFile part(const std::string& name, int begin, int end, const TrialSetup& setup = of_trials(10)) {
  return read_shard_file(to_text(setup, some_trials(begin, end)), name);
}

TEST(ShardFile, GivesBackEveryBit) {
  const ShardFile read = part("a.json", 2, 6);
  EXPECT_EQ(read.trials, some_trials(2, 6));
  EXPECT_EQ(to_text(read.setup, read.trials), to_text(of_trials(10), some_trials(2, 6)));
  EXPECT_EQ(read.setup.seed, of_trials(10).seed);
  EXPECT_EQ(read.setup.circles, 2);
  EXPECT_EQ(read.setup.circle_radius_m, of_trials(10).circle_radius_m);
  EXPECT_EQ(read.setup.e, of_trials(10).e);
  EXPECT_EQ(read.setup.windup_rad, of_trials(10).windup_rad);
}

TEST(ShardFile, SaysWhichRobotDrove) {
  TrialSetup setup = of_trials(10);
  for (const Model model : {Model::kinematic, Model::simulator}) {
    setup.model = model;
    EXPECT_EQ(part("a.json", 2, 6, setup).setup.model, model);
  }
  std::string other = to_text(setup, some_trials(2, 6));
  other.replace(other.find("simulator"), 9, "emulator?");
  EXPECT_THAT(told_by([&] { read_shard_file(other, "a.json"); }),
              Tells(SetupProblem::model_unknown, "emulator?"));
}

TEST(ShardFile, GivesBackWhatIsNoNumberAsThatAndNotAsNoAnswer) {
  std::vector<Trial> trials = some_trials(0, 2);
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  trials[1].errors[kMl] = Errors{std::nan(""), kInfinity, -kInfinity, 0, 1, 2, 3};
  trials[1].ml_chi_square = std::nan("");
  const std::string text = to_text(of_trials(2), trials);
  const std::vector<Trial> read = read_shard_file(text, "x.json").trials;
  const Errors errors = read[1].errors[kMl].value();
  EXPECT_TRUE(std::isnan(errors[0]));
  EXPECT_EQ(errors[1], kInfinity);
  EXPECT_EQ(errors[2], -kInfinity);
  EXPECT_EQ(errors[6], 3);
  EXPECT_TRUE(std::isnan(read[1].ml_chi_square.value()));
  EXPECT_FALSE(read[0].errors[kMl].has_value());
  EXPECT_FALSE(read[0].ml_chi_square.has_value());
  EXPECT_EQ(to_text(of_trials(2), read), text) << "and so on for ever";
}

TEST(ShardFile, ThatIsNoneIsNamed) {
  const auto none = Tells(StudyProblem::not_a_shard, "x.json");
  for (const std::string text : {"", "{}", "[1, 2", "{\"format\": 3", "name,x\n1,2\n"})
    EXPECT_THAT(told_by([&] { read_shard_file(text, "x.json"); }), none) << text;
  std::string cut = to_text(of_trials(10), some_trials(0, 5));
  cut.resize(cut.size() / 2);
  EXPECT_THAT(told_by([&] { read_shard_file(cut, "x.json"); }), none);
  const std::string old = R"({"format": "astrolabe study 0", "methods": []})";
  EXPECT_THAT(told_by([&] { read_shard_file(old, "x.json"); }),
              Tells(StudyProblem::shard_of_other_version, "x.json"));
}

TEST(ShardFile, OfShortValuesThatWouldTakeManyTimesItsSizeIsRefusedUnread) {
  std::string text = "[";
  while (text.size() < 20'000'000) text += "[],";
  const support::Taken taken = support::measured([&] {
    EXPECT_THAT(told_by([&] { read_shard_file(text, "x.json"); }),
                Tells(StudyProblem::not_a_shard, "x.json"));
  });
  EXPECT_BOUNDED(taken, text.size());
}

TEST(ShardFile, WithACountThatIsNoneIsRefused) {
  const std::string text = to_text(of_trials(10), some_trials(0, 1));
  const auto with = [&](const std::string& key, const std::string& value) {
    std::string changed = text;
    const std::size_t at = changed.find("\"" + key + "\": ") + key.size() + 4;
    changed.replace(at, changed.find_first_of(",\n", at) - at, value);
    return told_by([&] { merge({read_shard_file(changed, "x.json")}); });
  };
  for (const std::string count : {"1e300", "-1", "4294967306", "2.5", "1e999"}) {
    EXPECT_NE(with("trials", count).sentence, "") << count;
    EXPECT_NE(with("runs", count).sentence, "") << count;
    EXPECT_NE(with("trial", count).sentence, "") << count;
  }
  EXPECT_THAT(with("trials", "1000000000"),
              Tells(LimitProblem::out_of_range, "the number of trials", "1e+09"));
  EXPECT_THAT(with("runs", "4294967306"), Tells(NumberProblem::not_a_count, "runs", "4294967306"));
  EXPECT_THAT(with("trial", "-1"), Tells(NumberProblem::not_a_count, "trial", "-1"));
  EXPECT_THAT(with("seed", "1e300"), Tells(SetupProblem::seed_not_whole, "1e+300"));
}

TEST(Merge, OfFewTrialsTakesMemoryForThoseAloneWhateverCountIsClaimed) {
  const std::vector<ShardFile> parts{part("a", 0, 4, of_trials(10'000'000))};
  const support::Taken taken = support::measured([&] {
    EXPECT_THAT(told_by([&] { merge(parts); }),
                Tells(StudyProblem::trials_missing, "10000000", "4", "9999999"));
  });
  EXPECT_BOUNDED(taken, 0);
}

TEST(Merge, PutsTheTrialsInOrderWhateverTheOrderOfTheFiles) {
  const std::vector<Trial> merged = merge({part("c", 7, 10), part("a", 0, 3), part("b", 3, 7)});
  ASSERT_EQ(merged.size(), 10U);
  for (int i = 0; i < 10; ++i) EXPECT_EQ(merged[static_cast<std::size_t>(i)].index, i);
}

TEST(Merge, RefusesWhatIsNotOneWholeStudy) {
  const auto told = [](const std::vector<ShardFile>& parts) { return told_by([&] { merge(parts); }); };
  EXPECT_THAT(told({}), Tells(StudyProblem::no_shards));
  EXPECT_THAT(told({part("a", 0, 4), part("b", 3, 10)}), Tells(StudyProblem::trial_twice, "3", "a", "b"));
  EXPECT_THAT(told({part("a", 0, 4), part("b", 6, 10)}), Tells(StudyProblem::trials_missing, "10", "4", "5"));
  EXPECT_THAT(told({part("a", 1, 10)}), Tells(StudyProblem::trials_missing, "10", "0", "0"));
  TrialSetup other = of_trials(10);
  other.side_m = 2;
  EXPECT_THAT(told({part("a", 0, 4), part("b", 4, 10, other)}),
              Tells(StudyProblem::of_two_studies, "a", "side_m", "3.0", "b", "2.0"));
  other = of_trials(10);
  other.e = 0.02;
  EXPECT_THAT(told({part("a", 0, 4, other), part("b", 4, 10)}),
              Tells(StudyProblem::of_two_studies, "a", "e", "0.02", "b", "0.014285714285714285"));
  other = of_trials(10);
  other.model = Model::simulator;
  EXPECT_THAT(told({part("a", 0, 4), part("b", 4, 10, other)}),
              Tells(StudyProblem::of_two_studies, "a", "model", "\"kinematic\"", "b", "\"simulator\""));
  EXPECT_THAT(told({part("a", 0, 12)}), Tells(StudyProblem::shard_damaged, "a", "10", "10"));
}

}  // namespace
}  // namespace astro::simulation::study
