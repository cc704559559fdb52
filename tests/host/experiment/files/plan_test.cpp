#include "host/experiment/files/plan.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "host/experiment/files/method_names.hpp"
#include "host/experiment/files/plan_problem.hpp"
#include "tests/support/base/remarks.hpp"

namespace astro::experiment {
namespace {

using support::ThrowsTelling;

std::vector<std::string> titles(const Plan& plan, std::size_t phase) {
  std::vector<std::string> list;
  for (const RunSpec& spec : runs_of_phase(plan, phase, plan.runs)) list.push_back(spec.title());
  return list;
}

TEST(Plan, SurvivesJson) {
  Plan plan;
  plan.runs = 7;
  plan.side_m = 2.5;
  plan.order = Order::ccw_first;
  plan.rounds = 3;
  plan.extras = false;
  plan.method = method_named("umbmark", "thesis", "published");
  plan.truth = "manual";
  const nlohmann::json json = plan;
  EXPECT_EQ(nlohmann::json(json.get<Plan>()), json);
  plan.until = Until{5e-4, 12};
  plan.method = method_named("ml", "average", "exact");
  const nlohmann::json until = plan;
  EXPECT_EQ(nlohmann::json(until.get<Plan>()), until);
  EXPECT_EQ(until.get<Plan>().until->most, 12);
  EXPECT_NE(until, json);
}

TEST(Plan, OfAnOlderVersionHasOneCircleOfOneTurnEachWay) {
  nlohmann::json json = Plan();
  json.erase("circles");
  json.erase("circle_turns");
  const Plan plan = json.get<Plan>();
  EXPECT_EQ(plan.circles, 1);
  EXPECT_EQ(plan.circle_turns, 1);
}

TEST(Plan, AlternatesDirectionsUnlessToldOtherwise) {
  Plan plan;
  plan.runs = 2;
  plan.extras = false;
  EXPECT_EQ(titles(plan, 0), (std::vector<std::string>{"before: square cw 1", "before: square ccw 1",
                                                       "before: square cw 2", "before: square ccw 2"}));
  plan.order = Order::ccw_first;
  EXPECT_EQ(titles(plan, 1), (std::vector<std::string>{"after: square ccw 1", "after: square ccw 2",
                                                       "after: square cw 1", "after: square cw 2"}));
}

TEST(Plan, APersonMeasuresThreeLinesInPlaceOfALineAndCircles) {
  Plan plan;
  plan.runs = 1;
  plan.truth = "manual";
  EXPECT_EQ(titles(plan, 1), (std::vector<std::string>{"after: square cw 1", "after: square ccw 1",
                                                       "after: line 1", "after: line 2", "after: line 3"}));
}

TEST(Plan, DrivesExtrasInTheFirstAndTheLastPhaseOnly) {
  Plan plan;
  plan.runs = 1;
  plan.rounds = 2;
  EXPECT_EQ(runs_of_phase(plan, 0, plan.runs).size(), 7U);
  EXPECT_EQ(runs_of_phase(plan, 1, plan.runs).size(), 2U);
  EXPECT_EQ(runs_of_phase(plan, 2, plan.runs).size(), 7U);
}

TEST(Plan, RefusesWhatCannotBeDriven) {
  const auto refused = [](auto change, const std::string& name, const std::string& value) {
    Plan plan;
    change(plan);
    EXPECT_THAT([&] { plan.check(); }, ThrowsTelling(PlanProblem::out_of_range, name, value));
  };
  refused([](Plan& plan) { plan.runs = 0; }, "runs", "0");
  refused([](Plan& plan) { plan.side_m = 0; }, "side_m", "0");
  refused([](Plan& plan) { plan.side_m = std::nan(""); }, "side_m", "nan");
  refused([](Plan& plan) { plan.speed_mps = -1; }, "speed_mps", "-1");
  refused([](Plan& plan) { plan.rounds = 0; }, "rounds", "0");
}

TEST(Plan, IsOpenEndedWhereACalibrationFollowsAndAPrecisionIsWanted) {
  Plan plan;
  plan.rounds = 2;
  EXPECT_FALSE(open_ended(plan, 0));
  plan.until = Until{};
  EXPECT_TRUE(open_ended(plan, 0));
  EXPECT_TRUE(open_ended(plan, 1));
  EXPECT_FALSE(open_ended(plan, 2)) << "nothing is calibrated after the last phase";
}

TEST(Plan, RefusesAPrecisionThatCannotBeDrivenFor) {
  const auto refused = [](auto change, PlanProblem problem, const std::vector<std::string>& values) {
    Plan plan;
    plan.truth = "sim";
    plan.until = Until{5e-4, 10};
    EXPECT_NO_THROW(plan.check());
    change(plan);
    const Remark told = support::told_by([&] { plan.check(); });
    EXPECT_THAT(told, support::Tells(problem));
    EXPECT_EQ(told.values, values);
  };
  refused([](Plan& plan) { plan.until->target = 0; }, PlanProblem::out_of_range, {"target", "0"});
  refused([](Plan& plan) { plan.until->most = 1; }, PlanProblem::out_of_range, {"most", "1"});
  refused([](Plan& plan) { plan.order = Order::cw_first; }, PlanProblem::order_of_open_ended, {});
  refused([](Plan& plan) { plan.method = method_named("extended", "average", "exact"); },
          PlanProblem::method_without_precision, {"extended"});
  refused([](Plan& plan) { plan.truth = "manual"; }, PlanProblem::truth_without_precision, {"manual"});
}

TEST(MethodNames, ComeBackAsTheyWere) {
  for (const char* name : {"auto", "ml", "umbmark", "extended", "least-squares"})
    EXPECT_EQ(name_of(method_named(name, "average", "exact")), name);
}

TEST(MethodNames, NameTheWordThatIsNone) {
  EXPECT_THAT([] { method_named("magic", "average", "exact"); },
              ThrowsTelling(NameProblem::unknown, "magic", "method",
                            "auto, ml, scan, umbmark, extended, least-squares, robust"));
  EXPECT_THAT([] { order_named("sideways"); },
              ThrowsTelling(NameProblem::unknown, "sideways", "order of directions",
                            "alternating, cw-first, ccw-first"));
}

}  // namespace
}  // namespace astro::experiment
