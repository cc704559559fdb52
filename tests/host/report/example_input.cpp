#include "tests/host/report/example_input.hpp"

#include <cmath>
#include <numbers>
#include <random>

namespace astro::report {

namespace {

using calibration::EndPose;

constexpr double kWheelbase_m = 0.29, kStep_s = 0.02, kSpeed_mps = 0.25, kStanding_s = 0.5;
constexpr double kCounts_per_m = 12'393;  // ASTRO's wheels and encoders

// Millimetres and radians as printed in the thesis.
const std::vector<EndPose> kTable11{{-.27198, -.38585, .1874},
                                    {-.18993, -.15664, .1222},
                                    {-.16322, -.17355, .1206},
                                    {-.18673, -.23251, .1439},
                                    {-.30481, -.35147, .1821}};
const std::vector<EndPose> kTable12{{.29689, -.22972, .1603},
                                    {.28394, -.22984, .1782},
                                    {.41208, -.31136, .2058},
                                    {.31938, -.27406, .1842},
                                    {.25795, -.23358, .1448}};
const std::vector<EndPose> kTable13{{-.00194, -.00812, .0047},
                                    {-.03037, -.05288, .0101},
                                    {-.01958, .00944, -.0036},
                                    {-.0177, .00257, .0094},
                                    {-.12889, -.04697, .0478}};
const std::vector<EndPose> kTable14{{-.08088, .05113, .0523},
                                    {-.01734, .04201, .0076},
                                    {-.10211, .05415, .066},
                                    {-.07035, .10466, .0471},
                                    {-.06389, .04867, .0343}};

struct Motion {
  double ahead_m, turn_rad;
};

/// What the odometry believes at time t: sides with spins between them, a circle, or a line.
Motion believed_step(const std::string& kind, double sense, double t_s, double seconds) {
  constexpr double kPi = std::numbers::pi;
  const double ahead = kSpeed_mps * kStep_s;
  if (t_s < kStanding_s || t_s >= seconds - kStanding_s) return {0, 0};
  if (kind == "line") return {ahead, 0};
  if (kind == "circle") return {ahead, sense * 2 * kPi * kStep_s / (seconds - 2 * kStanding_s)};
  const double side_s = (seconds - 2 * kStanding_s) / 4, spin_s = 2;
  if (std::fmod(t_s - kStanding_s, side_s) < side_s - spin_s) return {ahead, 0};
  return {0, sense * kPi / 2 * kStep_s / spin_s};
}

void advance(double& x, double& y, double& theta, Motion m) {
  x += m.ahead_m * std::cos(theta + m.turn_rad / 2);
  y += m.ahead_m * std::sin(theta + m.turn_rad / 2);
  theta += m.turn_rad;
}

void add_drives(Phase& phase, int squares, double wheel_error, unsigned seed) {
  for (const Sense direction : {Sense::cw, Sense::ccw}) {
    for (int i = 1; i <= squares; ++i)
      phase.runs.push_back(example_run("square", direction, i, 57, wheel_error, ++seed));
    phase.runs.push_back(example_run("circle", direction, 1, 30, wheel_error, ++seed));
  }
  phase.runs.push_back(example_run("line", {}, 1, 12, wheel_error, ++seed));
  for (auto& run : phase.runs) run.info.phase = phase.title;
  phase.squares = calibration::summarize(phase.cw, phase.ccw);
}

recording::RunInfo info_of(const std::string& kind, std::optional<Sense> direction, int index) {
  return {.kind = kind,
          .direction = direction,
          .phase = "",
          .index = index,
          .size_m = kind == "circle" ? 1.2 : 3.0,
          .speed_mps = kSpeed_mps,
          .robot_name = "ASTRO",
          .robot_id = "51-7e-04",
          .board = "sim",
          .firmware = "0.1.0",
          .started_at = "2026-03-01T10:0" + std::to_string(index) + ":00Z",
          .truth_source = "sim",
          .truth_clock = "robot",
          .parameters = {{"c_R", 1}, {"c_L", 1}, {"b", kWheelbase_m}}};
}

}  // namespace

recording::Run example_run(const std::string& kind, std::optional<Sense> direction, int index, double seconds,
                           double wheel_error, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> noise;
  recording::Run run;
  run.info = info_of(kind, direction, index);
  double x = 0, y = 0, theta = 0, true_x = 1.5, true_y = -0.7, true_theta = 0.6, ahead = 0, turn = 0;
  const double sense = sign_of(direction.value_or(Sense::ccw));
  for (std::int64_t i = 0; static_cast<double>(i) * kStep_s <= seconds; ++i) {
    const auto time_us = 5'000'000 + i * 20'000;
    const auto counts = [&](double side) {
      return static_cast<std::int32_t>((ahead + side * turn * kWheelbase_m / 2) * kCounts_per_m);
    };
    run.odometry.push_back({.time_us = time_us,
                            .x_m = x,
                            .y_m = y,
                            .theta_rad = theta,
                            .left_counts = counts(-1),
                            .right_counts = counts(1)});
    run.truth.push_back({.time_us = time_us - 3'000, .x_m = true_x, .y_m = true_y, .theta_rad = true_theta});
    const Motion believed = believed_step(kind, sense, static_cast<double>(i) * kStep_s, seconds);
    ahead += believed.ahead_m;
    turn += believed.turn_rad;
    advance(x, y, theta, believed);
    const double slip =
        8e-4 * std::sqrt(std::abs(believed.ahead_m) + std::abs(believed.turn_rad) * kWheelbase_m / 2);
    const double drift = (believed.ahead_m * wheel_error + slip * noise(random)) / kWheelbase_m;
    advance(true_x, true_y, true_theta,
            {believed.ahead_m + slip * noise(random), believed.turn_rad * (1 + wheel_error / 3) + drift});
  }
  return run;
}

ReportInput thesis_input(int squares) {
  ReportInput input;
  input.title = "Calibration of ASTRO";
  input.description = {{"Robot", "ASTRO, 72 mm wheels, nominal wheelbase 290 mm"},
                       {"Track", "3 m square, five runs each way"}};
  input.phases.resize(2);
  input.phases[0] = {.title = "before", .runs = {}, .squares = {}, .cw = kTable11, .ccw = kTable12};
  input.phases[1] = {.title = "after", .runs = {}, .squares = {}, .cw = kTable13, .ccw = kTable14};
  add_drives(input.phases[0], squares, 4.1e-3, 100);
  add_drives(input.phases[1], squares, 2e-4, 200);
  input.parameters = {{"c_R", "", 1, 1.00207703, 0.00012},
                      {"c_L", "", 1, 0.99792297, 0.00012},
                      {"b", "m", 0.29, 0.28861105, 0.0011}};
  input.method =
      "UMBmark (Borenstein and Feng), alpha from x and beta from y.\n\nThe factors compose with those the "
      "robot carried.";
  input.notes = {"Seeds 100 to 205."};
  return input;
}

}  // namespace astro::report
