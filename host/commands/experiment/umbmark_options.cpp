#include "host/commands/experiment/umbmark_options.hpp"
#include "host/commands/shared/parameter_load.hpp"

#include "host/commands/base/flags.hpp"
#include "host/console/options.hpp"
#include "host/console/wrong_usage.hpp"

namespace astro::commands {
namespace {

/// Throws if the option is given with another source, with which it has no effect.
void require_truth(const UmbmarkOptions& options, const console::Option& option, const std::string& name,
                   const std::string& source) {
  if (option.count() > 0 && options.truth.source != source)
    throw console::WrongUsage(name + " is of --truth " + source + ", and this is --truth " +
                              options.truth.source);
}

}  // namespace

void add_umbmark_options(console::Command command, UmbmarkOptions& options) {
  experiment::Plan& plan = options.plan;
  add_connection(command, options.connection);
  command
      .add_option(
          "--truth", options.truth.source,
          "sim, manual (tape measure), film or film:FILE (a phone\nfilms a printed tag), wall (and "
          "ruler), file, "
          "lidar:PORT\n(an RPLIDAR on the robot), or a tracker:\nvrpn://HOST/BODY, natnet://HOST/BODY, "
          "ros2:/TOPIC (poses,\nor scans of a laser scanner)")
      .type_name("SOURCE")
      .check(truth_source({"sim", "manual", "file", "film", "wall", "lidar"}))
      .required();
  options.truth_folder = command.add_option("--truth-folder", options.truth.folder,
                                            "--truth file: where the CSV of each run appears;\n"
                                            "default: OUT/truth");
  add_mirrored_scans(command, options.truth);
  options.unit_option =
      command
          .add_option("--unit", options.unit,
                      "--truth manual, wall: of lengths typed without one; asked for\nif not given")
          .one_of({"mm", "cm", "m"});
  options.angle_unit_option =
      command.add_option("--angle-unit", options.angle_unit, "--truth manual: of headings typed without one")
          .one_of({"deg", "rad"})
          .capture_default_str();
  add_film_options(command, options.film_figures, "--truth film: ");
  command.add_option("--out", options.out, "folder of the experiment; the same folder again continues it")
      .required();
  const auto not_of_wall = [&options](const std::string& name, console::Option option) {
    options.not_of_wall.emplace_back(name, option);
  };
  not_of_wall("--runs", command.add_option("--runs", plan.runs, "squares in each direction, before and after")
                            .capture_default_str());
  options.until_option = command
                             .add_option("--until", options.until.target,
                                         "drive squares until E_d, the scale and b have\n"
                                         "standard errors below this, 0.05% or 0.0005;\n"
                                         "--runs then counts the squares after")
                             .transform(console::fraction());
  not_of_wall(
      "--max-runs",
      command.add_option("--max-runs", options.until.most, "--until: the most squares in each direction")
          .needs(options.until_option)
          .capture_default_str());
  not_of_wall("--side",
              command.add_option("--side", plan.side_m, "side of the square, m").capture_default_str());
  options.speed =
      command.add_option("--speed", plan.speed_mps, "m/s; --truth wall: 0.7").capture_default_str();
  options.yaw_rate =
      command.add_option("--yaw-rate", plan.yaw_rate_radps, "of the turns, rad/s; --truth wall: 1.8")
          .capture_default_str();
  not_of_wall("--order", command.add_option("--order", options.order, "of the directions")
                             .one_of({"alternating", "cw-first", "ccw-first"})
                             .capture_default_str());
  not_of_wall("--rounds", command
                              .add_option("--rounds", plan.rounds,
                                          "calibrate, upload and drive again so often, or until a\n"
                                          "calibration is not shown to be better")
                              .capture_default_str());
  options.line = command.add_option("--line", plan.line_m, "length of the straight line, or of a lap, m")
                     .capture_default_str();
  not_of_wall("--circle", command
                              .add_option("--circle", plan.circle_radius_m,
                                          "radius of the circles, m; with the squares they show e")
                              .capture_default_str());
  not_of_wall("--no-extras",
              command.add_flag(
                  "--no-extras", options.no_extras,
                  "squares only, no line and circles: whether gentle arcs\nturn about another wheelbase (e) "
                  "is not looked for"));
  add_method(command, options.method,
             {"auto", "ml", "scan", "umbmark", "extended", "least-squares", "robust"},
             "auto: scan with a laser scanner, ml (maximum likelihood\n"
             "over whole drives) with other ground truth along the\n"
             "way, else robust");
  not_of_wall("--pause", command.add_flag("--pause", options.pause,
                                          "wait for Enter before each run (always with --truth manual)"));
  add_wall_options(command, options.wall);
  add_yes(command, options.yes, "upload without asking what is better, or cannot be judged");
  add_force(command, options.force);
  command.add_flag("--json", options.json, "print the result as one JSON object");
}

void refuse_options_of_other_truth(const UmbmarkOptions& options) {
  for (const auto& [name, option] : options.wall.own) require_truth(options, option, name, "wall");
  require_truth(options, options.angle_unit_option, "--angle-unit", "manual");
  require_truth(options, options.truth_folder, "--truth-folder", "file");
  if (options.truth.source != "wall") {
    require_truth(options, options.unit_option, "--unit", "manual");
    return;
  }
  for (const auto& [name, option] : options.not_of_wall)
    if (option.count() > 0) throw console::WrongUsage(name + " is of squares, and --truth wall drives laps");
  if (options.method.method != "auto")
    throw console::WrongUsage("--method is of squares, and --truth wall drives laps");
}

}  // namespace astro::commands
