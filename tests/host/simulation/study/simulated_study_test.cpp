#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "host/simulation/study/kinematic_source.hpp"
#include "host/simulation/study/shard_file.hpp"
#include "host/simulation/study/simulated_source.hpp"
#include "host/simulation/study/study.hpp"
#include "host/simulation/study/summary.hpp"

// Studies of the simulated robot, compared with the same studies of the kinematic robot.
namespace astro::simulation {
namespace {

using simulation::study::Model;
using simulation::study::Row;
using simulation::study::Summary;
using simulation::study::Trial;
using simulation::study::TrialSetup;

const SimulatedSource kRobot;
const auto kSilent = [](int, int) {};

TrialSetup small_setup(int trials, Model model) {
  TrialSetup setup;
  setup.model = model;
  setup.trials = trials;
  setup.runs = 1;
  setup.side_m = 1;
  setup.seed = 2;
  return setup;
}

TEST(SimulatedStudy, ShardsMergedAreTheWholeToTheLastBitWhateverTheJobs) {
  TrialSetup setup = small_setup(5, Model::simulator);
  setup.clock_known = false;
  const std::vector<Trial> whole = run_study(setup, kRobot, {1, 1}, 1, kSilent);
  std::vector<simulation::study::ShardFile> parts;
  for (const int number : {2, 1})
    parts.push_back(simulation::study::read_shard_file(
        to_text(setup, run_study(setup, kRobot, {number, 2}, 3, kSilent)), std::to_string(number)));
  EXPECT_EQ(merge(parts), whole);
  EXPECT_EQ(parts.front().setup.model, Model::simulator);
}

// Both with their own noise: the difference of two rms in its standard errors.
double apart(const Row& a, const Row& b, std::size_t figure) {
  return (a.rms[figure] - b.rms[figure]) / std::hypot(a.se[figure], b.se[figure]);
}

// `astrolabe study` prints the full table over hundreds of trials of ten squares; here are enough trials to
// notice another slip, another noise, or factors with an error of half of theirs.
TEST(SimulatedStudy, AgreesWithTheKinematicOneWithinTheScatterOfBoth) {
  constexpr int kTrials = 40;
  const TrialSetup setup = small_setup(kTrials, Model::simulator);
  const Summary simulated = summarize(setup, kRobot, run_study(setup, kRobot, {1, 1}, 2, kSilent));
  const TrialSetup kinematic_setup = small_setup(kTrials, Model::kinematic);
  const simulation::study::KinematicSource robot;
  const Summary kinematic =
      summarize(kinematic_setup, robot, run_study(kinematic_setup, robot, {1, 1}, 2, kSilent));
  ASSERT_TRUE(simulated.failures.empty()) << simulated.failures.front();
  ASSERT_EQ(simulated.methods.size(), kinematic.methods.size());
  for (std::size_t m = 1; m < simulated.methods.size(); ++m) {
    const Row &a = simulated.methods[m], &b = kinematic.methods[m];
    for (const auto figure :
         {simulation::study::kE_d, simulation::study::kB_over_S, simulation::study::kE_max_m,
          simulation::study::kTheta_rad, simulation::study::kLine_m}) {
      fmt::print("{:18} figure {}: simulated {:.3g} ± {:.2g}, kinematic {:.3g} ± {:.2g}\n", a.name,
                 static_cast<int>(figure), a.rms[figure], a.se[figure], b.rms[figure], b.se[figure]);
      // The standard error of an rms of 40 heavy-tailed figures is itself known to a quarter.
      EXPECT_LT(std::abs(apart(a, b, figure)), 4) << a.name << ", figure " << figure;
    }
  }
  for (std::size_t figure = 0; figure < simulation::study::kFigures; ++figure) {
    if (figure == simulation::study::kCurvature) continue;  // none, and known to be none
    EXPECT_NEAR(simulated.bound.rms[figure] / kinematic.bound.rms[figure], 1, 0.03)
        << "ramps and rests of their own, and 1 % of chance in what is drawn";
  }
  ASSERT_TRUE(simulated.ml_covariance.has_value());
  fmt::print("chi-square {:.2f} ± {:.2f}, ml over the bound {:.2f} {:.2f} {:.2f}\n",
             simulated.ml_covariance->mean, simulated.ml_covariance->se, simulated.ml_over_bound[0].value,
             simulated.ml_over_bound[1].value, simulated.ml_over_bound[2].value);
  EXPECT_NEAR(simulated.ml_covariance->mean, 3, 3 * std::sqrt(6.0 / kTrials)) << "chi-square's own scatter";
  for (const simulation::study::Ratio& ratio : simulated.ml_over_bound)
    EXPECT_NEAR(ratio.value, 1, 3 * ratio.se);
}

}  // namespace
}  // namespace astro::simulation
