#include "host/wall/wall_journal.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "host/base/error.hpp"
#include "host/base/files.hpp"
#include "host/base/text/degrees.hpp"
#include "host/base/text/json_weight.hpp"
#include "host/base/utc.hpp"
#include "host/experiment/files/factors_json.hpp"

namespace astro::wall {
namespace {

using nlohmann::json;

constexpr int kFormat = 2;
// Six of it between two squarings are 26 degrees, beyond which the turns could be counted wrongly.
constexpr double kMostSquaring_rad = 0.0524;

std::filesystem::path file_in(const std::filesystem::path& folder) { return folder / "wall.json"; }

json numbers(const WheelTravel& travel) {
  return {travel.right_m, travel.left_m, travel.right_path_m, travel.left_path_m};
}

void require(bool holds, const std::string& what) {
  if (!holds) throw Error(what);
}

double within(const json& value, double least, double most, const char* what) {
  const auto number = value.get<double>();
  require(number >= least && number <= most, what);
  return number;
}

double finite(const json& value) { return within(value, -1e6, 1e6, "a number is out of range"); }

int whole(const json& value, int least, int most, const char* what) {
  require(value.is_number_integer(), what);
  const auto number = value.get<std::int64_t>();
  require(number >= least && number <= most, what);
  return static_cast<int>(number);
}

WheelTravel travel_in(const json& value) {
  require(value.size() == 4, "a travel has not four numbers");
  return {finite(value.at(0)), finite(value.at(1)), finite(value.at(2)), finite(value.at(3))};
}

/// Whether wheels can have rolled like this in between: paths only grow, and no travel is longer than its path.
bool is_way(const WheelTravel& way) {
  constexpr double kRounding_m = 1e-9;
  return way.path_m() > 0 && std::abs(way.right_m) <= way.right_path_m + kRounding_m &&
         std::abs(way.left_m) <= way.left_path_m + kRounding_m;
}

json object(const WallPlan& plan) {
  return {{"E_d", plan.targets.E_d},
          {"b", plan.targets.b},
          {"line_m", plan.line_m},
          {"readings", plan.readings},
          {"gap_m", plan.gap_m},
          {"speed_mps", plan.speed_mps},
          {"yaw_rate_radps", plan.yaw_rate_radps},
          {"most_minutes", plan.most_minutes},
          {"squaring_rad", plan.squaring_rad},
          {"push_N", plan.push.force_N},
          {"stall_Nm", plan.push.stall_Nm},
          {"stall_V", plan.push.stall_V},
          {"front_to_axle_m", plan.body.front_to_axle_m},
          {"length_m", plan.body.length_m},
          {"width_m", plan.body.width_m}};
}

WallPlan plan_in(const json& value) {
  WallPlan plan;
  plan.targets = {finite(value.at("E_d")), finite(value.at("b"))};
  plan.line_m = finite(value.at("line_m"));
  plan.readings = whole(value.at("readings"), 0, 1000, "the number of readings is out of range");
  plan.gap_m = finite(value.at("gap_m"));
  plan.speed_mps = finite(value.at("speed_mps"));
  plan.yaw_rate_radps = finite(value.at("yaw_rate_radps"));
  plan.most_minutes = finite(value.at("most_minutes"));
  plan.squaring_rad = finite(value.at("squaring_rad"));
  plan.push = {finite(value.at("push_N")), finite(value.at("stall_Nm")), finite(value.at("stall_V"))};
  plan.body = {finite(value.at("front_to_axle_m")), finite(value.at("length_m")),
               finite(value.at("width_m"))};
  plan.check();
  return plan;
}

json object(const WallSeries& series) {
  json squarings = json::array(), readings = json::array();
  for (const WheelTravel& travel : series.squarings) squarings.push_back(numbers(travel));
  for (const GapReading& reading : series.readings)
    readings.push_back(
        {{"travel", numbers(reading.travel)}, {"gap_m", reading.gap_m}, {"squaring", reading.squaring}});
  return {{"squarings", squarings}, {"readings", readings}};
}

WallSeries series_in(const json& value) {
  WallSeries series;
  for (const json& travel : value.at("squarings")) {
    const WheelTravel squaring = travel_in(travel);
    require(series.squarings.empty() || is_way(squaring - series.squarings.back()),
            "no wheels roll like that between two squarings");
    series.squarings.push_back(squaring);
  }
  require(!series.squarings.empty(), "a series has no squaring");
  for (const json& reading : value.at("readings")) {
    const int squaring = whole(reading.at("squaring"), 0, static_cast<int>(series.squarings.size()) - 1,
                               "a gap belongs to no squaring");
    series.readings.push_back({travel_in(reading.at("travel")),
                               within(reading.at("gap_m"), 1e-3, 100, "a gap is out of range"),
                               static_cast<std::size_t>(squaring)});
    const WheelTravel way = series.readings.back().travel - series.squarings[series.readings.back().squaring];
    require(is_way(way), "no wheels roll like that between a squaring and a gap");
    constexpr double kTimes = 2;  // a path of both wheels is twice the gap
    const double part = 2 * series.readings.back().gap_m / way.path_m();
    require(part > 1 / kTimes && part < kTimes, "a gap is not what the wheels rolled");
  }
  return series;
}

json object(const WallMove& move) {
  return {{"kind", static_cast<int>(move.kind)},
          {"away_m", move.away_m},
          {"turns", move.turns},
          {"line_m", move.line_m}};
}

WallMove move_in(const json& value) {
  const int kind = whole(value.at("kind"), 0, static_cast<int>(WallMove::Kind::spin), "a move is of no kind");
  return {static_cast<WallMove::Kind>(kind), within(value.at("away_m"), 0, 100, "a move is too long"),
          whole(value.at("turns"), -1000, 1000, "a move has too many turns"),
          within(value.at("line_m"), 0, 100, "a move is too long")};
}

calibration::WheelFactors loaded_in(const json& value) {
  const calibration::WheelFactors loaded = experiment::factors_in(value);
  for (const double c : {loaded.c_r, loaded.c_l})
    require(c >= 0.5 && c <= 1.5, "a loaded wheel factor is out of range");
  require(loaded.b_m >= 0.01 && loaded.b_m <= 5, "the loaded wheelbase is out of range");
  return loaded;
}

WallJournal journal_in(const json& value) {
  constexpr double kWeek_s = 604800;
  WallJournal journal;
  journal.plan = plan_in(value.at("plan"));
  value.at("robot").at("id").get_to(journal.robot.id);
  value.at("robot").at("name").get_to(journal.robot.name);
  value.at("started_at").get_to(journal.started_at);
  journal.count_m = within(value.at("count_m"), 1e-9, 1, "the travel of a count is out of range");
  journal.loaded = loaded_in(value.at("loaded"));
  std::size_t stretches = 0;
  for (const json& series : value.at("series")) {
    journal.drive.push_back(series_in(series));
    stretches += journal.drive.back().squarings.size() - 1;
  }
  for (const json& move : value.at("moves")) journal.moves.push_back(move_in(move));
  require(stretches == journal.moves.size(), "it has not as many moves as ways between squarings");
  journal.driven_s = within(value.at("driven_s"), 0, kWeek_s, "the time of driving is out of range");
  return journal;
}

bool is_within(double value, double least, double most) { return value >= least && value <= most; }

void require_possible(bool possible, const std::string& sentence, const std::vector<std::string>& values) {
  if (!possible) throw Error(sentence, WallProblem::impossible_plan, values);
}

/// `name`: in WallPlan.
void require_within(double value, double least, double most, const char* name, const std::string& sentence) {
  require_possible(is_within(value, least, most), sentence, {name, fmt::format("{:g}", value)});
}

}  // namespace

WallNoise WallPlan::usual_noise() const {
  WallNoise noise;
  noise.squaring_rad = squaring_rad;
  return noise;
}

void WallPlan::check() const {
  require_within(line_m, 0.5, 20, "line_m",
                 fmt::format("laps of {:g} m are not between 0.5 and 20 m", line_m));
  require_within(gap_m, 0.2, 20, "gap_m", fmt::format("a gap of {:g} m is not between 0.2 and 20 m", gap_m));
  require_within(readings, 0, 20, "readings",
                 fmt::format("{} readings of the ruler are not between 0 and 20", readings));
  require_within(speed_mps, 0.05, 2, "speed_mps",
                 fmt::format("a speed of {:g} m/s is not between 0.05 and 2", speed_mps));
  require_within(yaw_rate_radps, 0.1, 10, "yaw_rate_radps",
                 fmt::format("a yaw rate of {:g} rad/s is not between 0.1 and 10", yaw_rate_radps));
  require_within(most_minutes, 1, 120, "most_minutes",
                 fmt::format("{:g} minutes are not between 1 and 120", most_minutes));
  require_within(squaring_rad, 1e-4, kMostSquaring_rad, "squaring_rad",
                 fmt::format("an error of {:g} degrees against the wall is not between 0.006 and 3",
                             degrees(squaring_rad)));
  require_within(push.force_N, 0.5, 100, "push",
                 fmt::format("a push of {:g} N is not between 0.5 and 100", push.force_N));
  require_possible(
      is_within(push.stall_Nm, 1e-3, 1000) && is_within(push.stall_V, 1, 100),
      fmt::format("{:g} N m at {:g} V is no motor of a small robot", push.stall_Nm, push.stall_V), {"push"});
  require_possible(
      is_within(body.length_m, 0.05, 2) && is_within(body.width_m, 0.05, 2) &&
          is_within(body.front_to_axle_m, 0, body.length_m),
      fmt::format(
          "a body {:g} m long and {:g} m wide with the axle {:g} m behind its front is no small robot",
          body.length_m, body.width_m, body.front_to_axle_m),
      {"body"});
  for (const auto& [name, target] : {std::pair{"E_d", targets.E_d}, std::pair{"b", targets.b}})
    require_within(target, 1e-6, 0.1, name,
                   fmt::format("a standard error of {:g} is not between 0.000001 and 0.1", target));
}

std::optional<WallJournal> read_wall_journal(const std::filesystem::path& folder) {
  const std::filesystem::path path = file_in(folder);
  if (!std::filesystem::exists(path)) return std::nullopt;
  const Bytes bytes = load_file(path, kMaxSettingsBytes);
  const std::string damaged = "'" + path.string() + "' is damaged";
  if (!json_fits_memory(as_text(bytes))) throw Error(damaged, WallProblem::journal_damaged);
  json value;
  try {
    value = json::parse(bytes.begin(), bytes.end());
    if (value.at("format") == kFormat) return journal_in(value);
  } catch (const json::exception&) {
    throw Error(damaged, WallProblem::journal_damaged);
  } catch (const Error& error) {
    throw Error(damaged + " (" + error.what() + ")", WallProblem::journal_damaged);
  }
  throw Error("'" + path.string() +
              "' was written by another version of Astrolabe: use that one to go on with it");
}

void write_wall_journal(const std::filesystem::path& folder, const WallJournal& journal) {
  json series = json::array(), moves = json::array();
  for (const WallSeries& one : journal.drive) series.push_back(object(one));
  for (const WallMove& move : journal.moves) moves.push_back(object(move));
  const json value = {{"format", kFormat},
                      {"started_at", journal.started_at},
                      {"plan", object(journal.plan)},
                      {"robot", {{"id", journal.robot.id}, {"name", journal.robot.name}}},
                      {"count_m", journal.count_m},
                      {"loaded", experiment::to_json(journal.loaded)},
                      {"series", series},
                      {"moves", moves},
                      {"driven_s", journal.driven_s}};
  const std::string text = value.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
  PartFile file(file_in(folder));
  file.write({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  file.commit();
}

WallJournal open_wall_journal(const std::filesystem::path& folder, const WallPlan& plan,
                              const experiment::RobotIdentity& robot, const WallRobot& facts) {
  constexpr double kSame = 1e-9;
  if (auto journal = read_wall_journal(folder)) {
    const std::string where = "the calibration in '" + folder.string() + "'";
    if (object(journal->plan) != object(plan))
      throw Error(where + " has other settings", WallProblem::other_settings);
    if (const std::string other = experiment::different_robots(where, journal->robot, "this", robot);
        !other.empty())
      throw Error(other, WallProblem::other_robot);
    if (std::abs(journal->count_m / facts.count_m - 1) > kSame)
      throw Error(where + " was driven with another nominal wheel (diameter, gear or encoder)",
                  WallProblem::other_wheel);
    return *journal;
  }
  std::filesystem::create_directories(folder);
  WallJournal journal{plan, robot, utc_now(), facts.count_m, facts.loaded, {}, {}, 0};
  write_wall_journal(folder, journal);
  return journal;
}

}  // namespace astro::wall
