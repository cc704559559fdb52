#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <functional>
#include <memory>

#include "host/base/error.hpp"
#include "host/commands/base/advice.hpp"
#include "host/commands/base/flags.hpp"
#include "host/commands/robot/commands.hpp"
#include "host/commands/shared/connection.hpp"
#include "host/commands/shared/parameter_load.hpp"
#include "host/commands/shared/params_view.hpp"
#include "host/console/console.hpp"
#include "host/console/options.hpp"
#include "host/console/program.hpp"
#include "host/console/terminal.hpp"
#include "host/console/wrong_usage.hpp"
#include "host/experiment/analysis/calibration_file.hpp"
#include "host/import/drives/robot_geometry.hpp"
#include "host/robot/parameters/parameter_problem.hpp"
#include "host/robot/parameters/parameters.hpp"
#include "host/robot/parameters/upload.hpp"

namespace astro::commands {
namespace {

using experiment::ParameterValues;
using robot::Change;
using robot::RemoteParameters;

struct ParamsOptions {
  ConnectionOptions connection;
  std::vector<std::string> words;
  std::filesystem::path file;
  std::string controller;  // in a file of ROS 2 with several
  bool json = false, yes = false, force = false, try_out = false;
};

Json changed_json(const std::vector<Change>& changes, bool in_force) {
  Json list = Json::array();
  for (const Change& change : changes)
    list.push_back({{"name", change.name},
                    {"unit", change.unit},
                    {"before", to_json(change.before)},
                    {"after", to_json(change.after)}});
  return {{"in_force", in_force}, {"changed", list}};
}

void report(const ParamsOptions& options, const std::vector<Change>& changes, bool in_force) {
  if (options.json) print_json(changed_json(changes, in_force));
}

void list(const ParamsOptions& options, RemoteParameters& robot) {
  if (!options.json)
    return write(parameter_table(
        robot, console::stdout_is_terminal() ? console::terminal_size(STDOUT_FILENO).columns : 0));
  Json rows = Json::array();
  for (const robot::ParameterRow& row : robot.rows()) rows.push_back(to_json(row));
  print_json(rows);
}

void get(const ParamsOptions& options, RemoteParameters& robot) {
  Json json = Json::array();
  std::string text;
  for (const std::string& name : options.words) {
    const robot::ParameterRow& row = robot.row(name);
    json.push_back(to_json(row));
    text += (options.words.size() > 1 ? name + "=" : "") + plain(row) + '\n';
    if (!options.json && console::stderr_is_terminal())
      console::say(fmt::format("{}: {}", name, explanation(row)));
  }
  if (!options.json) return write(text);
  print_json(options.words.size() == 1 ? json.front() : json);
}

/// Puts all values in force or none: checks, stages, commits and reads them back.
void load(robot::Client& client, const ParamsOptions& options, RemoteParameters& robot,
          const ParameterValues& values) {
  const std::vector<Change> changes = robot::changes(robot, values);
  if (changes.empty()) {
    // They may only have been tried; then they are not in the flash yet.
    for (const auto& [name, value] : values) robot.stage(name, value);
    robot.commit();
    console::say("the robot holds these values already");
    return report(options, changes, true);
  }
  if (!agreed(robot, changes, options.yes)) throw Error("nothing was changed");
  const robot::UploadReport done = robot::upload(client, values);
  if (done.active != robot::ActiveSet::new_set) throw Error(done.remark());
  console::say(in_words(done.remark()));
  report(options, changes, true);
}

ParameterValues assignments(const RemoteParameters& robot, const std::vector<std::string>& words) {
  ParameterValues values;
  for (const std::string& word : words) {
    const auto equals = word.find('=');
    if (equals == std::string::npos || equals == 0)
      throw console::WrongUsage(
          fmt::format("'{}' sets nothing: write NAME=VALUE, for example b=0.2886", word));
    const std::string name = word.substr(0, equals);
    const auto value = parse_value(robot.row(name), word.substr(equals + 1));
    if (!values.emplace(name, value).second) throw console::WrongUsage(name + " is given twice");
  }
  return values;
}

void set(robot::Client& client, const ParamsOptions& options, RemoteParameters& robot) {
  const ParameterValues values = assignments(robot, options.words);
  if (!options.try_out) return load(client, options, robot, values);
  const std::vector<Change> changes = robot::changes(robot, values);
  if (options.try_out && !agreed(robot, changes, options.yes, changes.size()))
    throw Error("nothing was changed");
  for (const auto& [name, value] : values) robot.stage(name, value);
  console::say(console::table(experiment::side_by_side(changes), "llrrr"));
  robot.apply();
  console::say("in force until the robot restarts: 'astrolabe params save' keeps them");
  report(options, changes, true);
}

void save(const ParamsOptions& options, RemoteParameters& robot) {
  robot.save();
  console::say("the values in force, tried ones too, are now in the robot's flash");
  report(options, {}, true);
}

void defaults(const ParamsOptions& options, RemoteParameters& robot) {
  robot.defaults();
  const std::vector<Change> changes = staged_changes(robot);
  if (!changes.empty() && !agreed(robot, changes, options.yes)) {
    robot.revert();
    throw Error("nothing was changed");
  }
  robot.commit();  // even without changes, because values may only have been tried
  console::say(changes.empty() ? "the robot holds its defaults already, in its flash too"
                               : "in force, and in the robot's flash");
  report(options, changes, true);
}

void export_to_file(const ParamsOptions& options, RemoteParameters& robot) {
  ParameterValues values;
  for (const robot::ParameterRow& row : robot.rows()) values[row.name] = robot::to_value(row, row.active);
  experiment::write_parameters(options.file, values);
  console::say(fmt::format("the {} values in force, tried ones too, are now in {}", values.size(),
                           options.file.string()));
}

/// The parameters to be loaded from a file: one of ours, or one of a ROS 2 controller.
experiment::ParameterFile importable(const ParamsOptions& options) {
  if (!importing::is_controller_file(options.file)) return experiment::read_parameter_file(options.file);
  experiment::ParameterFile file;
  file.parameters =
      importing::parameters_of(importing::read_robot_file(options.file, options.controller), options.file);
  return file;
}

void import_from_file(robot::Client& client, const ParamsOptions& options, const RemoteParameters& robot) {
  const LoadResult loaded = load_parameters(client, robot, importable(options), {options.yes, options.force});
  if (loaded.advised_against) return console::answer_no();
  if (loaded.declined) throw Error("nothing was changed");
  if (loaded.report && loaded.report->active != robot::ActiveSet::new_set)
    throw Error(loaded.report->remark());
  if (loaded.report) console::say(in_words(loaded.report->remark()));
  report(options, loaded.changes, true);
}

using Work = std::function<void(robot::Client&, ParamsOptions&, RemoteParameters&)>;

console::Command add(console::Command params, const std::string& name, const std::string& what,
                     const std::shared_ptr<ParamsOptions>& options, Work work) {
  const console::Command command = params.add_subcommand(name, what);
  add_connection(command, options->connection);
  command.callback([options, work = std::move(work)] {
    const auto client = connect(options->connection);
    RemoteParameters robot = RemoteParameters::fetch(*client);
    work(*client, *options, robot);
  });
  return command;
}

Work without_client(void (*work)(const ParamsOptions&, RemoteParameters&)) {
  return [work](robot::Client&, ParamsOptions& options, RemoteParameters& robot) { work(options, robot); };
}

void add_readers(console::Command params, const std::shared_ptr<ParamsOptions>& options) {
  const console::Command all =
      add(params, "list", "show all parameters; * marks those that are not at their default", options,
          without_client(list));
  add_json_flag(all, options->json);
  console::examples(all, {"astrolabe params list", "astrolabe params list --json | jq -r '.[].name'"});

  const console::Command one = add(params, "get", "print values", options, without_client(get));
  one.add_option("name", options->words, "what 'params list' calls it").required().type_name("");
  add_json_flag(one, options->json);
  console::examples(
      one, {"astrolabe params get b", "astrolabe params get c_R c_L b", "astrolabe params get b --json"});

  const console::Command file =
      add(params, "export", "write the values in force, tried ones too, into a TOML file", options,
          without_client(export_to_file));
  file.add_option("file", options->file, "to be written").required().type_name("");
  console::examples(file, {"astrolabe params export astro.toml"});
}

void add_writers(console::Command params, const std::shared_ptr<ParamsOptions>& options) {
  const console::Command some = add(params, "set", "change values, all together or not at all", options, set);
  some.add_option("assignment", options->words, "NAME=VALUE, in the unit that 'params list' shows")
      .required()
      .type_name("");
  some.add_flag("--try", options->try_out, "in force until the robot restarts; gains even while it drives");
  console::examples(some,
                    {"astrolabe params set b=0.2886", "astrolabe params set c_R=1.0021 c_L=0.9979 --yes",
                     "astrolabe params set kp=50 --try"});

  const console::Command file =
      add(params, "import", "load values from a file, all together or not at all", options, import_from_file);
  file.add_option("file", options->file,
                  "of 'params export', a calibration, or parameters of ROS 2's\ndiff_drive_controller (YAML)")
      .required()
      .type_name("");
  file.add_option("--controller", options->controller, "the controller in a YAML file with several")
      .type_name("NAME");
  console::examples(file,
                    {"astrolabe params import astro.toml", "astrolabe params import astro.toml --yes --json",
                     "astrolabe params import diff_drive.yaml"});
  add_force(file, options->force);
  for (const console::Command command : {some, file}) {
    add_yes(command, options->yes, "do not ask");
    add_json_flag(command, options->json);
  }
}

void add_keepers(console::Command params, const std::shared_ptr<ParamsOptions>& options) {
  const console::Command keep = add(params, "save", "write the values in force, tried ones too, into flash",
                                    options, without_client(save));
  console::examples(keep, {"astrolabe params save"});
  const console::Command factory =
      add(params, "defaults", "put all parameters back to their defaults", options, without_client(defaults));
  console::examples(factory, {"astrolabe params defaults", "astrolabe params defaults --yes"});
  add_yes(factory, options->yes, "do not ask");
  for (const console::Command command : {keep, factory}) add_json_flag(command, options->json);
}

constexpr Advice kParamsAdvice[] = {
    {robot::ParameterProblem::unknown, ": 'astrolabe params list' shows those it has"},
    {robot::ParameterProblem::changed_by_another, ": 'astrolabe params list' shows what it has"},
};

}  // namespace

void add_params(console::Command app) {
  advise(kParamsAdvice);
  const auto options = std::make_shared<ParamsOptions>();
  const console::Command command =
      app.add_subcommand("params", "show, change, save and load the robot's parameters");
  command.require_subcommand(1, 1);
  add_readers(command, options);
  add_writers(command, options);
  add_keepers(command, options);
  console::examples(command, {"astrolabe params list", "astrolabe params set b=0.2886",
                              "astrolabe params export before.toml"});
}

}  // namespace astro::commands
