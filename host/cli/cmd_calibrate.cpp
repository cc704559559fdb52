#include <fmt/format.h>

#include <iostream>
#include <memory>

#include "host/base/error.hpp"
#include "host/calibration/end_pose_csv.hpp"
#include "host/cli/command.hpp"
#include "host/cli/console.hpp"
#include "host/experiment/calibration_file.hpp"
#include "host/experiment/json.hpp"
#include "host/experiment/method_names.hpp"
#include "host/experiment/squares.hpp"
#include "host/recording/files.hpp"
#include "host/recording/run_folder.hpp"

namespace astro::cli {
namespace {

namespace fs = std::filesystem;

struct Options {
  fs::path cw, ccw, folder, out;
  double side_m = 0;
  double wheelbase_m = 0;
  double c_r = 1, c_l = 1;
  std::string method = "auto", angles = "average", formula = "exact";
  bool json = false;
};

void add_method(CLI::App& command, Options& options) {
  command
      .add_option("--method", options.method,
                  "auto: extended where every run has an end heading, umbmark where not")
      ->check(CLI::IsMember({"auto", "umbmark", "extended", "least-squares"}))
      ->capture_default_str();
  command.add_option("--angles", options.angles, "umbmark: which end coordinates the angles are taken from")
      ->check(CLI::IsMember({"x", "y", "thesis", "average"}))
      ->capture_default_str();
  command.add_option("--formula", options.formula, "extended: exact, or as published by Jung and Chung")
      ->check(CLI::IsMember({"exact", "published"}))
      ->capture_default_str();
  command.add_option("--out", options.out, "write the result here, for 'astrolabe upload'");
  command.add_flag("--json", options.json, "print the result as one JSON object");
}

std::string read_text(const fs::path& path) {
  const recording::Bytes bytes = recording::load_file(path);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::string with_error(double value, double error, int decimals) {
  if (!std::isfinite(error)) return fmt::format("{:.{}f}", value, decimals);
  return fmt::format("{:.{}f} ± {:.{}f}", value, decimals, error, decimals);
}

void print_text(const calibration::Estimate& estimate) {
  constexpr double kDegree = 180 / 3.14159265358979323846;
  const calibration::ExperimentSummary& summary = estimate.summary;
  const auto cluster = [](const char* name, const calibration::ClusterSummary& c) {
    return std::vector<std::string>{
        name,
        fmt::format("{}", c.runs),
        fmt::format("{:.1f}", 1000 * c.x_cg_m),
        fmt::format("{:.1f}", 1000 * c.y_cg_m),
        std::isfinite(c.theta_cg_rad) ? fmt::format("{:.2f}", 1000 * c.theta_cg_rad) : "-",
        fmt::format("{:.1f}", 1000 * c.r_cg_m)};
  };
  std::cout << table({{"", "runs", "x_cg mm", "y_cg mm", "theta_cg mrad", "r_cg mm"},
                      cluster("cw", summary.cw),
                      cluster("ccw", summary.ccw)})
            << fmt::format("E_max_syst {} mm\n\n",
                           with_error(1000 * summary.E_max_syst_m, 1000 * summary.se_E_max_syst_m, 1));
  std::cout << table({{"method", std::string(calibration::name_of(estimate.options.method))},
                      {"alpha", fmt::format("{:.5f}°", estimate.alpha_rad * kDegree)},
                      {"beta", fmt::format("{:.5f}°", estimate.beta_rad * kDegree)},
                      {"R", fmt::format("{:.3f} m", estimate.radius_m)},
                      {"E_d", with_error(estimate.E_d, estimate.se.E_d, 7)},
                      {"E_b", with_error(estimate.E_b, estimate.se.E_b, 7)},
                      {"c_R", with_error(estimate.factors.c_r, estimate.se.c_r, 8)},
                      {"c_L", with_error(estimate.factors.c_l, estimate.se.c_l, 8)},
                      {"b mm", with_error(1000 * estimate.factors.b_m, 1000 * estimate.se.b_m, 4)}});
}

void finish(const calibration::Estimate& estimate, const Options& options) {
  if (!options.out.empty()) {
    experiment::write_calibration(options.out, estimate);
    say("written to " + options.out.string() + "; load it with: astrolabe upload " + options.out.string());
  }
  if (options.json) {
    std::cout << experiment::to_json(estimate).dump(2) << '\n';
  } else {
    print_text(estimate);
  }
}

void add_end_poses(CLI::App& calibrate) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = calibrate.add_subcommand("end-poses", "from measured end-pose errors of squares (CSV)");
  command
      ->add_option("--cw", options->cw,
                   "clockwise runs: columns ex_mm|ex_m, ey_mm|ey_m, etheta_rad|etheta_deg")
      ->required();
  command->add_option("--ccw", options->ccw, "counter-clockwise runs, the same columns")->required();
  command->add_option("--side", options->side_m, "side of the square, m")->required();
  command->add_option("--wheelbase", options->wheelbase_m, "wheelbase that the robot believed in, m")
      ->required();
  command->add_option("--c-right", options->c_r, "c_R that the robot carried")->capture_default_str();
  command->add_option("--c-left", options->c_l, "c_L that the robot carried")->capture_default_str();
  add_method(*command, *options);
  command->footer(
      "An error is absolute (tape measure, mocap) minus odometry, at the end, in the run's start frame.\n"
      "Examples:\n"
      "  astrolabe calibrate end-poses --cw cw.csv --ccw ccw.csv --side 3 --wheelbase 0.29\n"
      "  astrolabe calibrate end-poses --cw cw.csv --ccw ccw.csv --side 3 --wheelbase 0.29 --method umbmark "
      "--angles x --out calib.toml");
  command->callback([options] {
    experiment::Squares squares;
    squares.cw = calibration::read_end_poses(read_text(options->cw), options->cw.string());
    squares.ccw = calibration::read_end_poses(read_text(options->ccw), options->ccw.string());
    squares.side_m = options->side_m;
    squares.carried = {options->c_r, options->c_l, options->wheelbase_m};
    finish(experiment::estimate(squares,
                                experiment::method_named(options->method, options->angles, options->formula)),
           *options);
  });
}

void add_runs(CLI::App& calibrate) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = calibrate.add_subcommand("runs", "from recorded squares with ground truth (MCAP)");
  command->add_option("folder", options->folder, "folder with the recordings of one phase")->required();
  add_method(*command, *options);
  command->footer(
      "The result composes with the c_R, c_L and b that the robot carried while it was recorded.\n"
      "Examples:\n"
      "  astrolabe calibrate runs my-experiment/before --out calib.toml\n"
      "  astrolabe calibrate runs my-experiment/before --method umbmark --angles average --json");
  command->callback([options] {
    const std::vector<recording::Run> runs = recording::read_runs(options->folder);
    for (const recording::Run& run : runs)
      if (!run.warning.empty()) say("warning: " + run.warning);
    finish(experiment::estimate(experiment::squares_of(runs),
                                experiment::method_named(options->method, options->angles, options->formula)),
           *options);
  });
}

}  // namespace

void add_calibrate(CLI::App& app) {
  CLI::App* command = app.add_subcommand("calibrate", "compute c_R, c_L and b from driven squares");
  command->require_subcommand(1);
  command->footer(
      "Examples:\n"
      "  astrolabe calibrate end-poses --help\n"
      "  astrolabe calibrate runs my-experiment/before --out calib.toml");
  add_end_poses(*command);
  add_runs(*command);
}

}  // namespace astro::cli
