#include "host/experiment/files/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "host/base/error.hpp"
#include "host/base/text/numbers.hpp"
#include "host/experiment/files/method_names.hpp"
#include "host/experiment/files/plan_problem.hpp"

namespace astro::experiment {
namespace {

constexpr int kLinesByHand = 3;

bool within(double value, double least, double most) { return value >= least && value <= most; }

void need(bool condition, const std::string& sentence, Kind kind, std::vector<std::string> values = {}) {
  if (!condition) throw Error(sentence, kind, std::move(values));
}

void need_within(const char* name, double value, double least, double most, const std::string& sentence) {
  need(within(value, least, most), sentence, PlanProblem::out_of_range, {name, fmt::format("{}", value)});
}

int count_at(const nlohmann::json& json, const char* key) { return count_in(json.at(key).dump(), key); }

void check_until(const Plan& plan) {
  need_within("target", plan.until->target, 1e-6, 0.1,
              fmt::format("a precision of {:g} % cannot be driven for: 0.0001 % to 10 % are possible",
                          100 * plan.until->target));
  need_within("most", plan.until->most, kFewestPairs, 1000,
              fmt::format("at most {} squares in each direction cannot be driven: {} to 1000 are possible",
                          plan.until->most, kFewestPairs));
  need(plan.order == Order::alternating, "squares driven until a precision is reached alternate",
       PlanProblem::order_of_open_ended);
  need(plan.method.family != MethodChoice::Family::end_poses,
       "only maximum likelihood knows its precision as it goes", PlanProblem::method_without_precision,
       {std::string(name_of(plan.method))});
  need(plan.truth != "manual" && plan.truth != "file" && plan.truth != "film",
       "a precision can only be driven for with ground truth along the whole drive",
       PlanProblem::truth_without_precision, {plan.truth});
}

}  // namespace

void Plan::check() const {
  need_within("runs", runs, 1, 1000,
              fmt::format("{} runs in each direction cannot be driven: 1 to 1000 are possible", runs));
  if (until) check_until(*this);
  need_within("rounds", rounds, 1, 20,
              fmt::format("{} rounds cannot be driven: 1 to 20 are possible", rounds));
  need_within("side_m", side_m, 0.2, 100,
              fmt::format("a square of side {} m cannot be driven: 0.2 m to 100 m are possible", side_m));
  need_within("speed_mps", speed_mps, 0.01, 5,
              fmt::format("a speed of {} m/s cannot be driven: 0.01 to 5 m/s are possible", speed_mps));
  need_within(
      "yaw_rate_radps", yaw_rate_radps, 0.05, 20,
      fmt::format("a yaw rate of {} rad/s cannot be driven: 0.05 to 20 rad/s are possible", yaw_rate_radps));
  need_within("line_m", line_m, 0.1, 100,
              fmt::format("a line of {} m cannot be driven: 0.1 m to 100 m are possible", line_m));
  const std::string turns =
      fmt::format("{} circles of {} turns cannot be driven: 1 to 100 are possible", circles, circle_turns);
  need_within("circles", circles, 1, 100, turns);
  need_within("circle_turns", circle_turns, 1, 100, turns);
  need_within(
      "circle_radius_m", circle_radius_m, 0.1, 50,
      fmt::format("a circle of radius {} m cannot be driven: 0.1 m to 50 m are possible", circle_radius_m));
}

std::string_view name_of(Order order) {
  switch (order) {
    case Order::cw_first:
      return "cw-first";
    case Order::ccw_first:
      return "ccw-first";
    default:
      return "alternating";
  }
}

std::string RunSpec::file_name() const {
  if (!direction) return fmt::format("{}-{}.mcap", kind, index);
  return fmt::format("{}-{}-{}.mcap", kind, name_of(*direction), index);
}

std::string RunSpec::title() const {
  const std::string start = phase.empty() ? kind : phase + ": " + kind;
  if (!direction) return fmt::format("{} {}", start, index);
  return fmt::format("{} {} {}", start, name_of(*direction), index);
}

std::vector<std::string> phase_names(const Plan& plan) {
  std::vector<std::string> names{"before"};
  if (plan.rounds == 1) names.emplace_back("after");
  for (int i = 1; plan.rounds > 1 && i <= plan.rounds; ++i) names.push_back(fmt::format("after-{}", i));
  return names;
}

bool open_ended(const Plan& plan, std::size_t phase) {
  return plan.until.has_value() && phase + 1 < phase_names(plan).size();
}

std::vector<RunSpec> squares_of_phase(const Plan& plan, std::size_t phase, int squares) {
  const std::string name = phase_names(plan).at(phase);
  const Sense first = plan.order == Order::ccw_first ? Sense::ccw : Sense::cw;
  const Sense second = opposite(first);
  std::vector<RunSpec> specs;
  for (int i = 1; i <= squares; ++i) {
    specs.push_back({name, "square", first, i});
    if (plan.order == Order::alternating) specs.push_back({name, "square", second, i});
  }
  for (int i = 1; plan.order != Order::alternating && i <= squares; ++i)
    specs.push_back({name, "square", second, i});
  return specs;
}

std::vector<RunSpec> runs_of_phase(const Plan& plan, std::size_t phase, int squares) {
  std::vector<RunSpec> specs = squares_of_phase(plan, phase, squares);
  const std::string name = phase_names(plan).at(phase);
  const bool last = phase + 1 == phase_names(plan).size();
  if (!plan.extras || (phase > 0 && !last)) return specs;
  const bool by_hand = plan.truth == "manual";
  for (int i = 1; i <= (by_hand ? kLinesByHand : 1); ++i) specs.push_back({name, "line", {}, i});
  if (by_hand) return specs;
  for (int i = 1; i <= plan.circles; ++i) {
    specs.push_back({name, "circle", Sense::cw, i});
    specs.push_back({name, "circle", Sense::ccw, i});
  }
  return specs;
}

void to_json(nlohmann::json& json, const Plan& plan) {
  json = {{"runs", plan.runs},
          {"side_m", plan.side_m},
          {"speed_mps", plan.speed_mps},
          {"yaw_rate_radps", plan.yaw_rate_radps},
          {"order", name_of(plan.order)},
          {"rounds", plan.rounds},
          {"line_m", plan.line_m},
          {"circle_radius_m", plan.circle_radius_m},
          {"circles", plan.circles},
          {"circle_turns", plan.circle_turns},
          {"extras", plan.extras},
          {"method", name_of(plan.method)},
          {"angles", calibration::name_of(plan.method.options.angles)},
          {"formula", calibration::name_of(plan.method.options.formula)},
          {"truth", plan.truth},
          {"until", nullptr}};
  if (plan.until) json["until"] = {{"target", plan.until->target}, {"most", plan.until->most}};
}

void from_json(const nlohmann::json& json, Plan& plan) {
  plan.runs = count_at(json, "runs");
  json.at("side_m").get_to(plan.side_m);
  json.at("speed_mps").get_to(plan.speed_mps);
  json.at("yaw_rate_radps").get_to(plan.yaw_rate_radps);
  plan.order = order_named(json.at("order").get<std::string>());
  plan.rounds = count_at(json, "rounds");
  json.at("line_m").get_to(plan.line_m);
  json.at("circle_radius_m").get_to(plan.circle_radius_m);
  const auto count_or_one = [&](const char* key) { return json.contains(key) ? count_at(json, key) : 1; };
  plan.circles = count_or_one("circles");  // older versions drove one circle of one turn
  plan.circle_turns = count_or_one("circle_turns");
  json.at("extras").get_to(plan.extras);
  plan.method = method_named(json.at("method").get<std::string>(), json.at("angles").get<std::string>(),
                             json.at("formula").get<std::string>());
  json.at("truth").get_to(plan.truth);
  plan.until.reset();
  if (const auto& until = json.at("until"); !until.is_null())
    plan.until = Until{until.at("target").get<double>(), count_at(until, "most")};
}

}  // namespace astro::experiment
