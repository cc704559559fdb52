#include "host/experiment/calibration_file.hpp"

#include <fmt/format.h>

#include <toml++/toml.h>
#include <cmath>
#include <string_view>

#include "host/base/error.hpp"
#include "host/recording/files.hpp"

namespace astro::experiment {
namespace {

namespace fs = std::filesystem;

// Shortest digits that give the same double again, and always a float for TOML.
std::string real(double value) {
  if (!std::isfinite(value)) return "nan";
  std::string text = fmt::format("{}", value);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

void save(const fs::path& path, const std::string& text) {
  recording::PartFile file(path);
  file.write({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  file.commit();
}

std::string method_lines(const calibration::Estimate& estimate) {
  std::string text = fmt::format("method = \"{}\"\n", calibration::name_of(estimate.options.method));
  if (estimate.options.method == calibration::Method::umbmark)
    text += fmt::format("angles = \"{}\"\n", calibration::name_of(estimate.options.angles));
  if (estimate.options.method == calibration::Method::extended)
    text += fmt::format("formula = \"{}\"\n", calibration::name_of(estimate.options.formula));
  return text;
}

link::Value value_of(const toml::node& node, const std::string& where) {
  if (const auto number = node.value_exact<double>()) return *number;
  if (const auto integer = node.value_exact<std::int64_t>()) return static_cast<double>(*integer);
  if (const auto flag = node.value_exact<bool>()) return *flag ? 1.0 : 0.0;
  if (const auto text = node.value_exact<std::string>()) return *text;
  throw Error(where + " is neither a number nor a text");
}

toml::table parse(const fs::path& path) {
  const recording::Bytes bytes = recording::load_file(path);
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  try {
    return toml::parse(text, path.string());
  } catch (const toml::parse_error& error) {
    throw Error(fmt::format("'{}' line {} is not TOML: {}", path.string(), error.source().begin.line,
                            error.description()));
  }
}

}  // namespace

void write_calibration(const fs::path& path, const calibration::Estimate& estimate) {
  std::string text =
      "# Found by Astrolabe; 'astrolabe upload " + path.filename().string() + "' loads it.\n\n";
  text += fmt::format("[parameters]\nc_R = {}\nc_L = {}\nb = {} # m\n\n", real(estimate.factors.c_r),
                      real(estimate.factors.c_l), real(estimate.factors.b_m));
  text += fmt::format("[standard_errors]\nc_R = {}\nc_L = {}\nb = {} # m\n\n", real(estimate.se.c_r),
                      real(estimate.se.c_l), real(estimate.se.b_m));
  text +=
      fmt::format("# What the robot believed while it drove.\n[carried]\nc_R = {}\nc_L = {}\nb = {} # m\n\n",
                  real(estimate.carried.c_r), real(estimate.carried.c_l), real(estimate.carried.b_m));
  text += "[calibration]\n" + method_lines(estimate);
  text += fmt::format("side_m = {}\nruns_cw = {}\nruns_ccw = {}\nE_d = {}\nE_b = {}\nE_max_syst_m = {}\n",
                      real(estimate.side_m), estimate.summary.cw.runs, estimate.summary.ccw.runs,
                      real(estimate.E_d), real(estimate.E_b), real(estimate.summary.E_max_syst_m));
  save(path, text);
}

void write_parameters(const fs::path& path, const ParameterValues& values) {
  toml::table parameters;
  for (const auto& [name, value] : values) {
    if (const double* number = std::get_if<double>(&value)) {
      parameters.insert(name, *number);
    } else {
      parameters.insert(name, std::get<std::string>(value));
    }
  }
  std::ostringstream text;
  text << "# A robot's parameters; 'astrolabe params import' loads them.\n\n"
       << toml::table{{"parameters", parameters}} << '\n';
  save(path, text.str());
}

ParameterFile read_parameter_file(const fs::path& path) {
  const toml::table file = parse(path);
  const toml::table* parameters = file["parameters"].as_table();
  if (parameters == nullptr || parameters->empty())
    throw Error("'" + path.string() +
                "' has no [parameters]: it is no calibration and no export of a robot's parameters");
  ParameterFile result;
  for (const auto& [key, node] : *parameters) {
    const std::string name(key.str());
    result.parameters[name] = value_of(node, "'" + path.string() + "': [parameters] " + name);
  }
  if (const toml::table* carried = file["carried"].as_table())
    for (const auto& [key, node] : *carried)
      if (const auto number = node.value<double>()) result.carried[std::string(key.str())] = *number;
  return result;
}

}  // namespace astro::experiment
