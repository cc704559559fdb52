#include <memory>
#include <string_view>

#include "host/base/error.hpp"
#include "host/base/files.hpp"
#include "host/commands/base/advice.hpp"
#include "host/commands/calibrate/commands.hpp"
#include "host/console/console.hpp"
#include "host/console/options.hpp"
#include "host/experiment/analysis/analysis_problem.hpp"
#include "host/experiment/analysis/export.hpp"

namespace astro::commands {
namespace {

namespace fs = std::filesystem;

struct ExportOptions {
  fs::path file, to;
  std::string format, node = "diff_drive_controller";
  experiment::NominalSizes nominal;
};

std::string format_of(const ExportOptions& options) {
  if (!options.format.empty()) return options.format;
  const std::string extension = options.to.extension().string();
  if (extension == ".yaml" || extension == ".yml") return "ros2";
  if (extension == ".json") return "json";
  if (extension == ".toml") return "toml";
  throw Error("'" + options.to.string() +
              "' does not show the format by its extension (.yaml, .json, .toml): give --format");
}

/// JSON and TOML can leave out unknown sizes; ROS cannot.
std::optional<experiment::DiffDrive> sizes_if_known(const experiment::ParameterFile& file,
                                                    const experiment::NominalSizes& nominal) {
  if (!file.wheel && !nominal.wheel_radius_m) return std::nullopt;
  if (!file.loaded.contains("b") && !nominal.wheel_separation_m) return std::nullopt;
  return experiment::diff_drive(file, nominal);
}

/// Text that every earlier export in this format contains.
std::string_view mark_of(const std::string& format) {
  return format == "ros2" ? "# Found by Astrolabe" : format == "json" ? "\"c_R\":" : "[parameters]";
}

std::string text_of(const ExportOptions& options) {
  const std::string format = format_of(options);
  require_no_input(options.to, {options.file});
  require_own_kind(options.to, mark_of(format), "export");
  const experiment::ParameterFile file = experiment::read_parameter_file(options.file);
  std::optional<experiment::DiffDrive> sizes;
  try {
    experiment::require_loadable(file);
    sizes = format == "ros2" ? experiment::diff_drive(file, options.nominal)
                             : sizes_if_known(file, options.nominal);
  } catch (const Error& error) {
    throw Error(error.in("'" + options.file.string() + "': "));
  }
  if (sizes)
    if (const auto note = experiment::single_wheelbase(file, *sizes))
      console::say("warning: " + in_words(*note));
  if (format == "ros2") return experiment::ros2_yaml(file, *sizes, options.node);
  return format == "json" ? experiment::json_text(options.file, sizes)
                          : experiment::toml_text(options.file, sizes);
}

void run(const ExportOptions& options) {
  const std::string text = text_of(options);
  PartFile file(options.to);
  file.write({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  file.commit();
  console::say("written to " + options.to.string());
}

constexpr Advice kCalibrateExportAdvice[] = {
    {experiment::AnalysisProblem::no_calibration, ": name a file that 'astrolabe calibrate' wrote"},
    {experiment::AnalysisProblem::no_wheel_separation, ": give --wheel-separation"},
    {experiment::AnalysisProblem::no_wheel_radius, ": give --wheel-radius"},
};

}  // namespace

void add_calibrate_export(console::Command calibrate) {
  advise(kCalibrateExportAdvice);
  const auto options = std::make_shared<ExportOptions>();
  const console::Command command =
      calibrate.add_subcommand("export", "write a calibration for ROS 2, or as JSON or TOML");
  command.add_option("file", options->file, "calib.toml of 'calibrate' or 'umbmark'").required();
  command.add_option("--to", options->to, "the file to write").required();
  command
      .add_option(
          "--format", options->format,
          "ros2 (parameters of diff_drive_controller), json\nor toml; default: by the extension of --to")
      .one_of({"ros2", "json", "toml"});
  command
      .add_option("--wheel-radius", options->nominal.wheel_radius_m,
                  "nominal radius in the other program, m; default:\nthat of the robot that drove")
      .check(console::between(0.002, 2, "m"));
  command
      .add_option("--wheel-separation", options->nominal.wheel_separation_m,
                  "nominal wheelbase in the other program, m;\ndefault: the b that was loaded")
      .check(console::between(0.01, 10, "m"));
  command.add_option("--node", options->node, "ros2: name of the controller")
      .check([](const std::string& name) {
        return experiment::is_ros2_node(name)
                   ? ""
                   : "'" + name +
                         "' is no name of a node in ROS 2: use letters, digits and _, not a digit first, "
                         "and / before it or a namespace";
      })
      .capture_default_str();
  console::examples(command, {"astrolabe calibrate export calib.toml --to calib.yaml",
                              "astrolabe calibrate export calib.toml --to calib.yaml --wheel-radius 0.036 "
                              "--wheel-separation 0.3",
                              "astrolabe calibrate export calib.toml --to calib.json"});
  command.callback([options] { run(*options); });
}

}  // namespace astro::commands
