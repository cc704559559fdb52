#include "host/experiment/files/plan.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "host/base/error.hpp"
#include "host/experiment/files/method_names.hpp"
#include "tests/support/base/remarks.hpp"

namespace astro::experiment {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

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
  const auto refused = [](auto change, const char* what) {
    Plan plan;
    change(plan);
    EXPECT_THAT([&] { plan.check(); }, ThrowsMessage<Error>(HasSubstr(what)));
  };
  refused([](Plan& plan) { plan.runs = 0; }, "0 runs");
  refused([](Plan& plan) { plan.side_m = 0; }, "side 0 m");
  refused([](Plan& plan) { plan.side_m = std::nan(""); }, "side nan m");
  refused([](Plan& plan) { plan.speed_mps = -1; }, "speed of -1 m/s");
  refused([](Plan& plan) { plan.rounds = 0; }, "0 rounds");
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
  const auto refused = [](auto change, const char* fact, Help help, const std::string& value) {
    Plan plan;
    plan.truth = "sim";
    plan.until = Until{5e-4, 10};
    EXPECT_NO_THROW(plan.check());
    change(plan);
    EXPECT_THAT([&] { plan.check(); }, support::ThrowsTelling(HasSubstr(fact), help, value));
  };
  refused([](Plan& plan) { plan.until->target = 0; }, "precision of 0 %", Help::none, "");
  refused([](Plan& plan) { plan.until->most = 1; }, "at most 1 squares", Help::none, "");
  refused([](Plan& plan) { plan.order = Order::cw_first; }, "alternate", Help::keep_order, "");
  refused([](Plan& plan) { plan.method = method_named("extended", "average", "exact"); },
          "only maximum likelihood", Help::drop_precision_or_method, "extended");
  refused([](Plan& plan) { plan.truth = "manual"; }, "along the whole drive",
          Help::count_runs_or_change_truth, "manual");
}

TEST(MethodNames, ComeBackAsTheyWere) {
  for (const char* name : {"auto", "ml", "umbmark", "extended", "least-squares"})
    EXPECT_EQ(name_of(method_named(name, "average", "exact")), name);
}

TEST(MethodNames, NameTheWordThatIsNone) {
  EXPECT_THAT([] { method_named("magic", "average", "exact"); },
              ThrowsMessage<Error>(
                  HasSubstr("'magic' is no method: there are auto, ml, umbmark, extended, least-squares")));
  EXPECT_THAT([] { order_named("sideways"); }, ThrowsMessage<Error>(HasSubstr("'sideways'")));
}

}  // namespace
}  // namespace astro::experiment
