#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <memory>

#include "host/base/error.hpp"
#include "host/cli/command.hpp"
#include "host/cli/connection.hpp"
#include "host/cli/console.hpp"
#include "host/cli/options.hpp"
#include "host/cli/robot_view.hpp"
#include "host/experiment/calibration_file.hpp"
#include "host/experiment/change_guard.hpp"
#include "host/link/parameters.hpp"
#include "host/link/upload.hpp"

namespace astro::cli {
namespace {

using link::ParameterRow;
using link::RemoteParameters;

struct ParamsOptions {
  ConnectionOptions connection;
  std::string name;
  std::vector<std::string> assignments;
  std::filesystem::path file;
  bool yes = false, force = false, stage_only = false, json = false;
};

bool is_text(const ParameterRow& row) { return row.kind == protocol::ParameterKind::text; }

std::string shown(const ParameterRow& row, const link::RawValue& raw) {
  const link::Value value = to_value(row, raw);
  if (const double* number = std::get_if<double>(&value)) return fmt::format("{:.9g}", *number);
  return std::get<std::string>(value);
}

std::string limits(const ParameterRow& row) {
  if (is_text(row)) return fmt::format("{} to {} characters", row.minimum, row.maximum);
  return fmt::format("{:.6g} to {:.6g}", to_real(row, row.minimum), to_real(row, row.maximum));
}

Json as_json(const ParameterRow& row) {
  Json json = {{"name", row.name}, {"unit", row.unit}};
  const auto put = [&](const char* key, const link::RawValue& raw) {
    const link::Value value = to_value(row, raw);
    if (const double* number = std::get_if<double>(&value)) {
      json[key] = *number;
    } else {
      json[key] = std::get<std::string>(value);
    }
  };
  put("value", row.active);
  put("staged", row.staged);
  if (!is_text(row)) {
    json["default"] = to_real(row, row.default_value);
    json["minimum"] = to_real(row, row.minimum);
    json["maximum"] = to_real(row, row.maximum);
  }
  json["doc"] = row.doc;
  return json;
}

void list(ParamsOptions& options) {
  const auto client = connect(options.connection);
  const RemoteParameters parameters = RemoteParameters::fetch(*client);
  if (options.json) {
    Json json = Json::array();
    for (const ParameterRow& row : parameters.rows()) json.push_back(as_json(row));
    return print(json);
  }
  std::vector<std::vector<std::string>> rows{{"parameter", "value", "unit", "default", "limits"}};
  for (const ParameterRow& row : parameters.rows()) {
    const bool changed = !is_text(row) && row.active.raw != row.default_value;
    const std::string staged = row.staged == row.active ? "" : " (staged " + shown(row, row.staged) + ")";
    rows.push_back({(changed ? "* " : "  ") + row.name, shown(row, row.active) + staged, row.unit,
                    is_text(row) ? "" : fmt::format("{:.9g}", to_real(row, row.default_value)), limits(row)});
  }
  print(table(rows) + "\n* differs from the default; 'astrolabe params get NAME' explains a parameter");
}

void get(ParamsOptions& options) {
  const auto client = connect(options.connection);
  const RemoteParameters parameters = RemoteParameters::fetch(*client);
  const ParameterRow& row = parameters.row(options.name);
  if (options.json) return print(as_json(row));
  print(fmt::format("{} = {} {}\n  {}\n  limits {}{}", row.name, shown(row, row.active), row.unit, row.doc,
                    limits(row),
                    is_text(row) ? "" : fmt::format(", default {:.9g}", to_real(row, row.default_value))));
}

/// "c_R=1.002" as the robot's own table understands it.
void take(const std::string& assignment, const RemoteParameters& parameters,
          experiment::ParameterValues& values) {
  const std::size_t equals = assignment.find('=');
  if (equals == std::string::npos || equals == 0)
    throw Error("'" + assignment + "' assigns nothing: write NAME=VALUE, such as c_R=1.002");
  const std::string name = assignment.substr(0, equals);
  const std::string text = assignment.substr(equals + 1);
  if (is_text(parameters.row(name))) {
    values[name] = text;
    return;
  }
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size())
    throw Error(fmt::format("{} takes a number, and '{}' is none", name, text));
  values[name] = number;
}

/// Shows what changes, asks where it is more than one value, loads all or nothing.
void load(link::Client& client, const RemoteParameters& parameters, const experiment::ParameterValues& values,
          const ParamsOptions& options) {
  const std::vector<experiment::Change> list = experiment::changes(parameters, values);
  if (list.empty()) return say("the robot holds these values already");
  say(table(experiment::side_by_side(list)));
  if (const std::string doubt = experiment::suspicion(list); !doubt.empty() && !options.force)
    throw Error(doubt);
  if (list.size() > 1 && !options.yes && !confirm("Load these into the robot?"))
    throw Error("nothing was changed");
  const link::UploadReport report = link::upload(client, values);
  say(report.sentence());
  if (report.active != link::ActiveSet::new_set)
    throw Error("the robot still holds the old parameters: try again");
}

void set(ParamsOptions& options) {
  const auto client = connect(options.connection);
  RemoteParameters parameters = RemoteParameters::fetch(*client);
  experiment::ParameterValues values;
  for (const std::string& assignment : options.assignments) take(assignment, parameters, values);
  if (!options.stage_only) return load(*client, parameters, values, options);
  for (const auto& [name, value] : values) parameters.stage(name, value);
  say("staged; 'astrolabe params save' puts it in force, 'astrolabe params revert' drops it");
}

std::size_t staged_count(const RemoteParameters& parameters) {
  return static_cast<std::size_t>(
      std::count_if(parameters.rows().begin(), parameters.rows().end(),
                    [](const ParameterRow& row) { return row.staged != row.active; }));
}

void save(ParamsOptions& options) {
  const auto client = connect(options.connection);
  RemoteParameters parameters = RemoteParameters::fetch(*client);
  const std::size_t staged = staged_count(parameters);
  if (staged == 0) return say("nothing is staged");
  parameters.commit();
  say(fmt::format("{} staged values are in force and in flash", staged));
}

void revert(ParamsOptions& options) {
  const auto client = connect(options.connection);
  RemoteParameters parameters = RemoteParameters::fetch(*client);
  const std::size_t staged = staged_count(parameters);
  parameters.revert();
  say(staged == 0 ? std::string("nothing was staged") : fmt::format("{} staged values are dropped", staged));
}

void export_to(ParamsOptions& options) {
  const auto client = connect(options.connection);
  const RemoteParameters parameters = RemoteParameters::fetch(*client);
  experiment::ParameterValues values;
  for (const ParameterRow& row : parameters.rows()) values[row.name] = to_value(row, row.active);
  experiment::write_parameters(options.file, values);
  say(fmt::format("{} parameters written to {}", values.size(), options.file.string()));
}

void import_from(ParamsOptions& options) {
  const experiment::ParameterValues values = experiment::read_parameter_file(options.file).parameters;
  const auto client = connect(options.connection);
  load(*client, RemoteParameters::fetch(*client), values, options);
}

void defaults(ParamsOptions& options) {
  const auto client = connect(options.connection);
  RemoteParameters parameters = RemoteParameters::fetch(*client);
  if (!options.yes && !confirm("Put all parameters back to factory defaults, the calibration included?"))
    throw Error("nothing was changed");
  parameters.defaults();
  parameters.commit();
  say("the robot holds the factory defaults");
}

}  // namespace

void add_params(CLI::App& app) {
  const auto options = std::make_shared<ParamsOptions>();
  CLI::App& command = *app.add_subcommand("params", "read and change the robot's parameters");
  command.require_subcommand(1);
  examples(command, {"astrolabe params list", "astrolabe params get b",
                     "astrolabe params set c_R=1.002 c_L=0.998 --yes", "astrolabe params export robot.toml",
                     "astrolabe params import robot.toml"});
  const auto add = [&](const char* name, const char* what, void (*run)(ParamsOptions&),
                       std::initializer_list<const char*> lines) -> CLI::App& {
    CLI::App& sub = *command.add_subcommand(name, what);
    add_connection(sub, options->connection);
    examples(sub, lines);
    sub.callback([options, run] { run(*options); });
    return sub;
  };
  const auto add_assent = [&](CLI::App& sub) {
    sub.add_flag("--yes,-y", options->yes, "do not ask");
    sub.add_flag("--force", options->force, "also where c_R, c_L or b change by more than 10 %");
  };
  add_json_flag(add("list", "all parameters with units and limits", list,
                    {"astrolabe params list", "astrolabe params list --json"}),
                options->json);
  CLI::App& get_command =
      add("get", "one parameter", get, {"astrolabe params get b", "astrolabe params get b --json"});
  get_command.add_option("name", options->name, "the parameter")->required();
  add_json_flag(get_command, options->json);
  CLI::App& set_command =
      add("set", "change parameters; in force and in flash together or not at all", set,
          {"astrolabe params set robot_name=Rosie", "astrolabe params set c_R=1.002 c_L=0.998 --yes"});
  set_command.add_option("assignments", options->assignments, "NAME=VALUE, SI units")->required();
  set_command.add_flag("--stage-only", options->stage_only, "prepare only: 'params save' puts it in force");
  add_assent(set_command);
  add("save", "put staged values in force and into flash", save, {"astrolabe params save"});
  add("revert", "drop staged values", revert, {"astrolabe params revert"});
  add("export", "write all parameters to a TOML file", export_to, {"astrolabe params export robot.toml"})
      .add_option("file", options->file, "the file to write")
      ->required();
  CLI::App& import_command = add("import", "load parameters from a TOML file", import_from,
                                 {"astrolabe params import robot.toml --yes"});
  import_command.add_option("file", options->file, "the file to read")->required();
  add_assent(import_command);
  add_assent(add("defaults", "put everything back to factory defaults", defaults,
                 {"astrolabe params defaults --yes"}));
}

}  // namespace astro::cli
