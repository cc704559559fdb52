#include "host/experiment/analysis/export.hpp"

#include <fmt/format.h>

#include <toml++/toml.h>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "common/params/table.hpp"
#include "host/base/error.hpp"
#include "host/base/text/columns.hpp"
#include "host/calibration/judgement/remarks.hpp"
#include "host/experiment/analysis/analysis_problem.hpp"
#include "host/experiment/files/curvature_named.hpp"
#include "host/experiment/files/number_named.hpp"
#include "host/experiment/files/toml_file.hpp"

namespace astro::experiment {
namespace {

namespace fs = std::filesystem;

double in_unit(const ParamRow& row, std::int32_t raw) {
  return row.kind == ParamKind::decimal_scaled ? raw / std::pow(10.0, -row.exponent)
                                               : std::ldexp(raw, row.exponent);
}

/// A value outside the limits of the parameter table is not a calibration of any robot. Names that the table
/// lacks belong to another firmware version, which checks them itself.
void require_possible(const std::string& name, double value) {
  const ParamRow* row = find_param(name);
  if (row == nullptr || row->kind == ParamKind::text) return;
  const double least = in_unit(*row, row->minimum_raw), most = in_unit(*row, row->maximum_raw);
  if (value >= least && value <= most) return;
  const std::string unit = row->unit == "1" ? "" : " " + std::string(row->unit);
  throw Error(fmt::format(
      "{} = {:.9g}{} is out of range: {:g}{} to {:g}{}, so that a robot would refuse it; calibrate again",
      name, value, unit, least, unit, most, unit));
}

double factor(const ParameterFile& file, const std::string& name) {
  const std::optional<double> value = number_named(file.parameters, name);
  if (!value || !std::isfinite(*value) || *value <= 0)
    throw Error("it has no " + name + " under [parameters]", AnalysisProblem::no_calibration, {name});
  require_possible(name, *value);
  return *value;
}

toml::table extended(const fs::path& path, const std::optional<DiffDrive>& parameters) {
  toml::table file = parse_toml(path);
  if (parameters)
    file.insert_or_assign(
        "diff_drive_controller",
        toml::table{{"wheel_radius", parameters->wheel_radius_m},
                    {"wheel_separation", parameters->wheel_separation_m},
                    {"left_wheel_radius_multiplier", parameters->left_wheel_radius_multiplier},
                    {"right_wheel_radius_multiplier", parameters->right_wheel_radius_multiplier},
                    {"wheel_separation_multiplier", parameters->wheel_separation_multiplier}});
  return file;
}

std::string comment(const Remark& note) { return wrapped(note.sentence + ".", kTextColumns, "# "); }

std::string value_text(const toml::node& node) {
  std::ostringstream text;
  if (const auto number = node.value_exact<double>()) return real_text(*number);
  if (const toml::array* array = node.as_array()) {
    for (const toml::node& value : *array) text << (text.str().empty() ? "[" : ", ") << value_text(value);
    return text.str() + (array->empty() ? "[]" : "]");
  }
  node.visit([&](const auto& value) { text << value; });
  return text.str();
}

nlohmann::json to_json(const toml::node& node) {
  nlohmann::json json;
  if (const toml::table* table = node.as_table()) {
    json = nlohmann::json::object();
    for (const auto& [key, value] : *table) json[std::string(key.str())] = to_json(value);
  } else if (const toml::array* array = node.as_array()) {
    json = nlohmann::json::array();
    for (const toml::node& value : *array) json.push_back(to_json(value));
  } else if (const auto integer = node.value_exact<std::int64_t>()) {
    json = *integer;
  } else if (const auto number = node.value_exact<double>(); number && std::isfinite(*number)) {
    json = *number;
  } else if (const auto flag = node.value_exact<bool>()) {
    json = *flag;
  } else if (const auto text = node.value_exact<std::string>()) {
    json = *text;
  }
  return json;
}

}  // namespace

void require_loadable(const ParameterFile& file) {
  for (const auto& [name, value] : file.parameters)
    if (const double* number = std::get_if<double>(&value)) require_possible(name, *number);
}

DiffDrive diff_drive(const ParameterFile& file, const NominalSizes& nominal) {
  const double c_r = factor(file, "c_R"), c_l = factor(file, "c_L"), b_m = factor(file, "b");
  const std::optional<double> separation_m =
      nominal.wheel_separation_m ? nominal.wheel_separation_m : number_named(file.loaded, "b");
  if (!separation_m)
    throw Error("it does not tell the wheelbase that was loaded in the robot",
                AnalysisProblem::no_wheel_separation);
  if (!file.wheel && !nominal.wheel_radius_m)
    throw Error("it does not tell the nominal wheel that c_R and c_L refer to",
                AnalysisProblem::no_wheel_radius);
  // The factors refer to the nominal wheel of the file or, if it names none, to that of the receiver.
  const double our_radius_m = file.wheel ? file.wheel->diameter_m / 2 : *nominal.wheel_radius_m;
  DiffDrive result;
  result.wheel_radius_m = nominal.wheel_radius_m.value_or(our_radius_m);
  result.wheel_separation_m = *separation_m;
  result.left_wheel_radius_multiplier = c_l * our_radius_m / result.wheel_radius_m;
  result.right_wheel_radius_multiplier = c_r * our_radius_m / result.wheel_radius_m;
  result.wheel_separation_multiplier = b_m / result.wheel_separation_m;
  return result;
}

std::optional<Remark> single_wheelbase(const ParameterFile& file, const DiffDrive& parameters) {
  const double e = with_curvature_named({}, file.parameters, "the calibration").e;
  constexpr double kNothing = 5e-4;
  if (std::abs(e) < kNothing) return std::nullopt;
  const auto error = file.standard_errors.find("e");
  const auto shown =
      calibration::two_wheelbases(e, error == file.standard_errors.end() ? std::nan("") : error->second);
  const double b_m = factor(file, "b");
  const std::string e_text = fmt::format("{:.4g}", e), percent = fmt::format("{:.1f}", 100 * std::abs(e)),
                    too = e > 0 ? "far" : "little",
                    multiplier = fmt::format("{:.6g}", parameters.wheel_separation_multiplier * (1 + e));
  return Remark{fmt::format("diff_drive_controller knows one wheelbase, and this robot {} two: spins turn "
                            "about {:.6g} m, which is written, gentle arcs about {:.6g} m (e = {}), so that "
                            "its odometry turns them up to {} % too {}; drive with the odometry of "
                            "Astrolabe's firmware, which has both, or set wheel_separation_multiplier to {} "
                            "if the robot mostly drives arcs",
                            shown == calibration::Shown::clearly   ? "has"
                            : shown == calibration::Shown::perhaps ? "perhaps has"
                                                                   : "may have",
                            b_m, b_m * (1 + e), e_text, percent, too, multiplier),
                ExportProblem::second_wheelbase,
                {e_text, percent, too, multiplier}};
}

bool is_ros2_node(std::string_view name) {
  constexpr std::size_t kLongest = 255;
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
  if (name.size() > kLongest) return false;
  if (name.starts_with('/')) name.remove_prefix(1);
  bool at_start = true;  // of the name or of a part of it
  for (const char c : name) {
    const bool is_digit = c >= '0' && c <= '9';
    if (c == '/' ? at_start : !is_letter(c) && (!is_digit || at_start)) return false;
    at_start = c == '/';
  }
  return !at_start;
}

std::string ros2_yaml(const ParameterFile& file, const DiffDrive& parameters, const std::string& node) {
  std::string text = "# Found by Astrolabe";
  const bool is_word = file.method.find_first_not_of("abcdefghijklmnopqrstuvwxyz-") == std::string::npos;
  if (!file.method.empty() && is_word)
    text += ", method " + file.method;  // anything else might end the comment
  text +=
      ".\n# wheel_radius and wheel_separation are nominal: the multipliers\n# belong to these very values.\n";
  if (const auto note = single_wheelbase(file, parameters)) text += comment(*note);
  text += node + ":\n  ros__parameters:\n";
  text += fmt::format("    wheel_radius: {}\n", real_text(parameters.wheel_radius_m));
  text += fmt::format("    wheel_separation: {}\n", real_text(parameters.wheel_separation_m));
  text += fmt::format("    left_wheel_radius_multiplier: {}\n",
                      real_text(parameters.left_wheel_radius_multiplier));
  text += fmt::format("    right_wheel_radius_multiplier: {}\n",
                      real_text(parameters.right_wheel_radius_multiplier));
  text +=
      fmt::format("    wheel_separation_multiplier: {}\n", real_text(parameters.wheel_separation_multiplier));
  return text;
}

std::string toml_text(const fs::path& path, const std::optional<DiffDrive>& parameters) {
  std::string text;
  for (const auto& [section, node] : extended(path, parameters)) {
    const toml::table* table = node.as_table();
    if (table == nullptr) continue;  // only tables of values are exported
    text += fmt::format("{}[{}]\n", text.empty() ? "" : "\n", section.str());
    for (const auto& [key, value] : *table) text += fmt::format("{} = {}\n", key.str(), value_text(value));
  }
  return toml_file(kFoundFactors, text);
}

std::string json_text(const fs::path& path, const std::optional<DiffDrive>& parameters) {
  return to_json(extended(path, parameters)).dump(2) + '\n';
}

}  // namespace astro::experiment
