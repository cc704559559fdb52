#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "host/base/text/columns.hpp"
#include "host/base/text/numbers.hpp"
#include "host/calibration/gyro/gyro_calibration.hpp"
#include "host/commands/base/advice.hpp"
#include "host/commands/calibrate/calibration_output.hpp"
#include "host/commands/calibrate/commands.hpp"
#include "host/commands/shared/gyro_view.hpp"
#include "host/commands/shared/import_options.hpp"
#include "host/commands/shared/robot_view.hpp"
#include "host/commands/shared/unused_choices.hpp"
#include "host/console/console.hpp"
#include "host/console/options.hpp"
#include "host/experiment/analysis/gyro_runs.hpp"
#include "host/experiment/analysis/likelihood_sentences.hpp"

namespace astro::commands {
namespace {

constexpr Advice kGyroAdvice[] = {
    {calibration::GyroProblem::no_rates,
     ": of bags, --imu-topic names the IMU; a robot of ours records its gyro if gyro_axis is set"},
    {calibration::GyroProblem::nothing_alike, ": --imu-axis names the axis of a bag's IMU that points up"}};

std::string factors_text(const experiment::GyroAlone& found, double scale_percent) {
  using experiment::with_error;
  const calibration::WheelFactors &now = found.factors, &old = found.loaded;
  const double se_c = found.E_d_se / 2;  // the mean of both stays as it is
  return console::table(
      {{"", "", "loaded", ""},
       {"E_d", with_error(now.c_r / now.c_l, found.E_d_se, 7), fmt::format("{:.6f}", old.c_r / old.c_l),
        "c_R over c_L"},
       {"c_R", with_error(now.c_r, se_c, 8), fmt::format("{:.6f}", old.c_r), ""},
       {"c_L", with_error(now.c_l, se_c, 8), fmt::format("{:.6f}", old.c_l), ""},
       {"b mm", with_error(1000 * now.b_m, 1000 * found.b_se_m, 4), fmt::format("{:.3f}", 1000 * old.b_m),
        fmt::format("if the gyro's scale is right to {:g} %", scale_percent)}});
}

std::string text_of(const experiment::GyroAlone& found, double scale_percent) {
  const calibration::GyroAgainstWheels& wheels = found.against_wheels;
  return factors_text(found, scale_percent) + '\n' +
         wrapped(fmt::format("Wheels and gyro alone do not show S, the size of both wheels, which is as "
                             "loaded; and no drive judges "
                             "these factors. If the loaded wheelbase is right instead, the gyro measures "
                             "{:.5f} ± {:.5f} of what the "
                             "robot turned{}. {}",
                             std::abs(wheels.product), wheels.product_se,
                             wheels.product < 0 ? ", clockwise instead of counter-clockwise" : "",
                             experiment::timing_sentence(wheels))) +
         slips_text(wheels, found.names);
}

}  // namespace

void add_calibrate_gyro(console::Command calibrate) {
  advise(kGyroAdvice);
  struct Options {
    ImportOptions import;
    double scale_percent = 1;  // what a sensor's data sheet grants
    bool json = false;
  };
  const auto options = std::make_shared<Options>();
  const console::Command command = calibrate.add_subcommand(
      "gyro", "from wheels and a gyro alone, without ground truth: c_R over c_L and b");
  command
      .add_option("drives", options->import.wheels,
                  "a recording or a bag with an IMU for each drive: .mcap, .bag, .db3\nor a folder")
      .required();
  add_bag_choices(command, options->import);
  add_geometry_choices(command, options->import);
  add_ranged(command, "--gyro-scale-error", options->scale_percent, "standard error of the gyro's scale",
             "PERCENT", 0.001, 20, "%")
      .capture_default_str();
  command.add_flag("--json", options->json, "print the result as one JSON object");
  command.footer(
      "Rests, straight lines and turns both ways show most. A tracker, scans or full turns against a wall\n"
      "show the gyro's scale to a tenth of a percent, and then b as well.\n"
      "Examples:\n"
      "  astrolabe calibrate gyro drive.mcap --wheel-diameter 0.066 --wheelbase 0.16\n"
      "  astrolabe calibrate gyro my-experiment/before/*.mcap --gyro-scale-error 0.1");
  command.callback([options] {
    refuse_unused_choices(options->import);
    const experiment::RunSet set = read_wheel_files(options->import);
    const experiment::GyroAlone found = experiment::factors_by_gyro(set, options->scale_percent / 100);
    if (options->json)
      print_json(experiment::to_json(found));
    else
      write(text_of(found, options->scale_percent));
  });
}

}  // namespace astro::commands
