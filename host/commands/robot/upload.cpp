#include <memory>
#include <nlohmann/json.hpp>

#include "host/base/error.hpp"
#include "host/commands/base/advice.hpp"
#include "host/commands/base/flags.hpp"
#include "host/commands/robot/commands.hpp"
#include "host/commands/shared/connection.hpp"
#include "host/commands/shared/parameter_load.hpp"
#include "host/commands/shared/params_view.hpp"
#include "host/commands/shared/robot_view.hpp"
#include "host/console/console.hpp"
#include "host/console/options.hpp"
#include "host/console/program.hpp"
#include "host/experiment/analysis/calibration_file.hpp"

namespace astro::commands {
namespace {

struct UploadOptions {
  ConnectionOptions connection;
  std::filesystem::path file;
  bool yes = false, force = false, json = false;
};

void print_report(const robot::UploadReport& report, bool json) {
  if (!json) {
    print(in_words(report.remark()));
    return;
  }
  nlohmann::json object = {{"active", report.active == robot::ActiveSet::new_set ? "new" : "old"},
                           {"link_dropped", report.link_dropped},
                           {"parameters", nlohmann::json::object()}};
  for (const robot::UploadedValue& value : report.values)
    object["parameters"][value.name] = {{"unit", value.unit},
                                        {"before", to_json(value.before)},
                                        {"wanted", to_json(value.wanted)},
                                        {"now", to_json(value.now)}};
  print_json(object);
}

void run(UploadOptions& options) {
  const experiment::ParameterFile file = experiment::read_parameter_file(options.file);
  const auto client = connect(options.connection);
  const robot::RemoteParameters robot = robot::RemoteParameters::fetch(*client);
  const LoadResult loaded = load_parameters(*client, robot, file, {options.yes, options.force});
  if (loaded.advised_against) return console::answer_no();
  if (loaded.declined) throw Error("nothing was changed");
  const robot::UploadReport report =
      loaded.report.value_or(robot::UploadReport{robot::ActiveSet::new_set, false, {}});
  if (loaded.report || options.json) print_report(report, options.json);
  if (report.active != robot::ActiveSet::new_set)
    throw Error("the robot still holds the old parameters: upload again");
}

}  // namespace

void add_upload(console::Command app) {
  const auto options = std::make_shared<UploadOptions>();
  const console::Command command =
      app.add_subcommand("upload", "load a calibration into the robot, checked and read back");
  command.add_option("file", options->file, "calib.toml of 'calibrate', or a file of 'params export'")
      .required();
  add_connection(command, options->connection);
  add_yes(command, options->yes, "do not ask; loads nothing that is not shown to be better");
  add_force(command, options->force);
  command.add_flag("--json", options->json, "print what the robot now holds as one JSON object");
  command.footer(
      "All values come in force together or not at all, also when the link drops in the middle.\n"
      "Examples:\n"
      "  astrolabe upload calib.toml\n"
      "  astrolabe upload calib.toml --port /dev/ttyACM0 --yes --json");
  command.callback([options] { run(*options); });
}

}  // namespace astro::commands
