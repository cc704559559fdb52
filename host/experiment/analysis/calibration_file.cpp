#include "host/experiment/analysis/calibration_file.hpp"

#include <fmt/format.h>

#include <cmath>
#include <sstream>

#include "host/base/error.hpp"
#include "host/base/files.hpp"
#include "host/base/text/plain_text.hpp"
#include "host/experiment/analysis/analysis_problem.hpp"
#include "host/experiment/analysis/judgement_sentences.hpp"
#include "host/experiment/analysis/parameter_file_problem.hpp"
#include "host/experiment/files/toml_file.hpp"

namespace astro::experiment {
namespace {

namespace fs = std::filesystem;

void save(const fs::path& path, const std::string& what, const std::string& body) {
  const std::string text = toml_file(what, body);
  require_own_kind(path, "[parameters]", "calibration or parameter file");
  PartFile file(path);
  file.write({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  file.commit();
}

std::string factor_lines(double c_r, double c_l, double b_m, double e) {
  return fmt::format("c_R = {}\nc_L = {}\nb = {} # m\ne = {}\n", real_text(c_r), real_text(c_l),
                     real_text(b_m), real_text(e));
}

std::string factor_lines(const calibration::WheelFactors& factors) {
  return factor_lines(factors.c_r, factors.c_l, factors.b_m, factors.e) +
         fmt::format("kappa0 = {}\n\n", real_text(factors.kappa0));
}

std::string end_pose_lines(const calibration::Estimate& estimate) {
  std::string text;
  if (estimate.options.method == calibration::Method::umbmark)
    text += fmt::format("angles = \"{}\"\n", calibration::name_of(estimate.options.angles));
  if (estimate.options.method == calibration::Method::extended)
    text += fmt::format("formula = \"{}\"\n", calibration::name_of(estimate.options.formula));
  return text + fmt::format("side_m = {}\n", real_text(estimate.side_m));
}

std::string covariance_lines(const calibration::FactorCovariance& covariance) {
  std::string text = "# Rows and columns c_R, c_L, b (m), e.\n[covariance]\nmatrix = [\n";
  for (int i = 0; i < 4; ++i)
    text += fmt::format("  [{}, {}, {}, {}],\n", real_text(covariance(i, 0)), real_text(covariance(i, 1)),
                        real_text(covariance(i, 2)), real_text(covariance(i, 3)));
  return text + "]\n\n";
}

std::string slip_lines(double K_m) {
  return fmt::format(
      "# Variance of a wheel's slip for each metre that it turns, in m^2/m.\n[slip]\nK = {}\n\n",
      real_text(K_m));
}

std::string nominal_lines(const NominalWheel& wheel) {
  std::string text =
      fmt::format("# The wheel that c_R and c_L refer to.\n[nominal]\nwheel_diameter = {} # m\n",
                  real_text(wheel.diameter_m));
  if (!wheel.turns_as_angle())
    text += fmt::format("counts_per_wheel_turn = {}\n", real_text(wheel.counts_per_turn));
  return text + '\n';
}

std::string robot_lines(const RobotIdentity& robot) {
  std::ostringstream text;
  text << "[robot]\nname = " << toml::value(robot.name) << "\nid = " << toml::value(robot.id) << "\n\n";
  return text.str();
}

std::string calibration_lines(const Calibration& calibration) {
  std::string text = fmt::format("[calibration]\nmethod = \"{}\"\n", calibration.method());
  text += fmt::format(
      "absolute = {} # {}\n", calibration.absolute(),
      calibration.absolute() ? "true whatever is loaded in the robot by now" : "only on top of [carried]");
  if (const calibration::Estimate* estimate = calibration.end_poses()) text += end_pose_lines(*estimate);
  if (const MlResult* ml = calibration.ml()) text += fmt::format("runs = {}\n", ml->estimate.runs.size());
  text += fmt::format("E_d = {}\nE_b = {}\nscale = {}\n", real_text(calibration.E_d()),
                      real_text(calibration.E_b()), real_text(calibration.scale()));
  if (calibration.line_scale) text += fmt::format("lines = {}\n", calibration.line_scale->lines);
  if (calibration.squares)
    text += fmt::format("runs_cw = {}\nruns_ccw = {}\nE_max_syst_m = {}\n", calibration.squares->cw.runs,
                        calibration.squares->ccw.runs, real_text(calibration.squares->E_max_syst_m));
  return text;
}

std::string verdict_lines(const Calibration& calibration) {
  std::ostringstream text;
  text << "\n# On drives that the calibration had not seen.\n[verdict]\nverdict = \""
       << name_of(calibration.judgement.verdict)
       << "\"\nsentence = " << toml::value(judgement_sentence(calibration)) << '\n';
  return text.str();
}

robot::Value value_of(const toml::node& node, const fs::path& path, const std::string& name) {
  if (const auto number = node.value_exact<double>()) return *number;
  if (const auto integer = node.value_exact<std::int64_t>()) return static_cast<double>(*integer);
  if (const auto flag = node.value_exact<bool>()) return *flag ? 1.0 : 0.0;
  if (const auto text = node.value_exact<std::string>()) return *text;
  throw Error(fmt::format("'{}' line {}: [parameters] {} is neither a number nor a text", path.string(),
                          node.source().begin.line, name),
              ParameterFileProblem::value_of_other_type, {path.string(), name});
}

std::map<std::string, double> numbers_in(toml::node_view<const toml::node> section) {
  std::map<std::string, double> numbers;
  if (const toml::table* table = section.as_table())
    for (const auto& [key, node] : *table)
      if (const auto number = node.value<double>()) numbers[std::string(key.str())] = *number;
  return numbers;
}

/// People name an experiment's folder instead of a calibration in it, so the error names one.
[[noreturn]] void fail_for_folder(const fs::path& folder) {
  for (const auto& entry : fs::directory_iterator(folder))
    if (const fs::path& file = entry.path(); file.extension() == ".toml")
      throw Error(fmt::format("'{}' is a folder: name a calibration in it, such as '{}'", folder.string(),
                              file.string()));
  throw Error(fmt::format("'{}' is a folder that holds no calibration", folder.string()),
              AnalysisProblem::no_calibration);
}

NominalWheel wheel_of(const toml::table& file, const fs::path& path) {
  const NominalWheel wheel{file["nominal"]["wheel_diameter"].value_or(0.0),
                           file["nominal"]["counts_per_wheel_turn"].value_or(kAngleCounts)};
  if (!(wheel.diameter_m > 0) || !(wheel.counts_per_turn > 0))
    throw Error("'" + path.string() + "': [nominal] needs a wheel_diameter and counts_per_wheel_turn above 0",
                ParameterFileProblem::bad_wheel, {path.string()});
  return wheel;
}

calibration::FactorCovariance covariance_of(const toml::table& file, const fs::path& path) {
  // Older versions wrote three rows of three numbers.
  const toml::array* matrix = file["covariance"]["matrix"].as_array();
  const int size = matrix != nullptr && matrix->size() == 3 ? 3 : 4;
  calibration::FactorCovariance covariance = calibration::FactorCovariance::Zero();
  for (int row = 0; row < size; ++row)
    for (int column = 0; column < size; ++column) {
      const auto entry =
          file["covariance"]["matrix"][static_cast<std::size_t>(row)][static_cast<std::size_t>(column)]
              .value<double>();
      if (!entry || !std::isfinite(*entry))
        throw Error("'" + path.string() +
                        "': [covariance] needs a matrix of four rows of four numbers, or three of three",
                    ParameterFileProblem::bad_covariance, {path.string()});
      covariance(row, column) = *entry;
    }
  return covariance;
}

double slip_of(const toml::table& file, const fs::path& path) {
  const double K_m = file["slip"]["K"].value_or(-1.0);
  if (!(K_m >= 0) || !std::isfinite(K_m))
    throw Error("'" + path.string() + "': [slip] needs a K of 0 or more, in metres",
                ParameterFileProblem::bad_slip, {path.string()});
  return K_m;
}

/// NaN if it is missing or not above 0.
double error_of(const ParameterFile& file, const std::string& name) {
  const auto found = file.standard_errors.find(name);
  return found != file.standard_errors.end() && found->second > 0 ? found->second : FactorErrors::kUnknown;
}

/// Over the value. NaN if either is missing.
double relative_error(const ParameterFile& file, const std::string& name) {
  const auto found = file.parameters.find(name);
  const double* const value = found == file.parameters.end() ? nullptr : std::get_if<double>(&found->second);
  return value == nullptr ? FactorErrors::kUnknown : error_of(file, name) / *value;
}

}  // namespace

std::optional<calibration::FactorCovariance> covariance_in(const ParameterFile& file) {
  if (file.covariance) return file.covariance;
  const double e = error_of(file, "e");
  // With S as loaded, c_R is too large by as much as c_L is too small.
  const calibration::DayDrift errors{relative_error(file, "c_R") + relative_error(file, "c_L"),
                                     kErrorOfNominalScale, relative_error(file, "b"),
                                     std::isfinite(e) ? e : calibration::PriorOfE::kStandardDeviation};
  if (!std::isfinite(errors.E_d + errors.b_over_scale)) return {};
  const auto value = [&](const char* name) { return std::get<double>(file.parameters.at(name)); };
  return errors.covariance({value("c_R"), value("c_L"), value("b")});
}

void write_calibration(const fs::path& path, const Calibration& calibration) {
  const calibration::WheelFactors &factors = calibration.factors, &loaded = calibration.loaded;
  std::string text =
      "# Spins turn about b, gentle arcs about b (1 + e).\n[parameters]\n" + factor_lines(factors);
  const FactorErrors& se = calibration.se_another_day;
  text +=
      "# On another day: the error of these drives, and what robots change by from day to day.\n"
      "[standard_errors]\n" +
      factor_lines(se.c_r, se.c_l, se.b_m, se.e) + '\n';
  if (calibration.covariance_another_day) text += covariance_lines(*calibration.covariance_another_day);
  if (const MlResult* ml = calibration.ml()) text += slip_lines(ml->estimate.noise.K_m);
  if (calibration.wheel) text += nominal_lines(*calibration.wheel);
  if (!calibration.robot.id.empty()) text += robot_lines(calibration.robot);
  text += "# The factors that were loaded in the robot while it drove.\n[carried]\n" + factor_lines(loaded);
  save(path, kFoundFactors, text + calibration_lines(calibration) + verdict_lines(calibration));
}

void write_parameters(const fs::path& path, const ParameterValues& values) {
  toml::table parameters;
  for (const auto& [name, value] : values) {
    if (const double* number = std::get_if<double>(&value)) {
      parameters.insert(name, *number);
    } else {
      parameters.insert(name, plain_text(std::get<std::string>(value)));
    }
  }
  std::ostringstream text;
  text << toml::table{{"parameters", parameters}} << '\n';
  save(path,
       "The values in force in a robot, exported by Astrolabe. Values that were only tried are among them.",
       text.str());
}

void write_parameter_file(const fs::path& path, const ParameterFile& file) {
  const auto section = [](const char* name, const std::map<std::string, double>& numbers) {
    std::string text = fmt::format("[{}]\n", name);
    for (const auto& [key, value] : numbers) text += fmt::format("{} = {}\n", key, real_text(value));
    return text + '\n';
  };
  std::ostringstream text;
  text << "[parameters]\n";
  for (const auto& [name, value] : file.parameters) {
    if (const double* number = std::get_if<double>(&value)) {
      text << fmt::format("{} = {}\n", name, real_text(*number));
    } else {
      text << name << " = " << toml::value(plain_text(std::get<std::string>(value))) << '\n';
    }
  }
  text << '\n' << section("standard_errors", file.standard_errors);
  if (file.covariance) text << covariance_lines(*file.covariance);
  if (file.slip_K_m) text << slip_lines(*file.slip_K_m);
  if (file.wheel) text << nominal_lines(*file.wheel);
  if (!file.robot.id.empty()) text << robot_lines(file.robot);
  text << "# The factors that were loaded in the robot while it drove.\n"
       << section("carried", file.loaded) << "[calibration]\nmethod = \"" << plain_text(file.method)
       << "\"\nabsolute = " << (file.absolute ? "true" : "false")
       << "\n\n# On drives that the calibration had not seen.\n[verdict]\nverdict = \""
       << name_of(file.verdict) << "\"\nsentence = " << toml::value(file.verdict_sentence) << '\n';
  save(path, kFoundFactors, text.str());
}

ParameterFile read_parameter_file(const fs::path& path) {
  if (fs::is_directory(path)) fail_for_folder(path);
  const toml::table file = parse_toml(path);
  const toml::table* parameters = file["parameters"].as_table();
  if (parameters == nullptr || parameters->empty())
    throw Error("'" + path.string() +
                    "' has no [parameters]: it is no calibration and no export of a robot's parameters",
                ParameterFileProblem::no_parameters, {path.string()});
  ParameterFile result;
  for (const auto& [key, node] : *parameters) {
    const std::string name(key.str());
    result.parameters[name] = value_of(node, path, name);
  }
  result.loaded = numbers_in(file["carried"]);
  result.standard_errors = numbers_in(file["standard_errors"]);
  result.robot = {file["robot"]["name"].value_or(std::string()), file["robot"]["id"].value_or(std::string())};
  result.method = file["calibration"]["method"].value_or(std::string());
  result.absolute = file["calibration"]["absolute"].value_or(false);
  result.verdict = verdict_named(file["verdict"]["verdict"].value_or(std::string()));
  result.verdict_sentence = file["verdict"]["sentence"].value_or(std::string());
  if (file.contains("nominal")) result.wheel = wheel_of(file, path);
  if (file.contains("slip")) result.slip_K_m = slip_of(file, path);
  if (file.contains("covariance")) result.covariance = covariance_of(file, path);
  return result;
}

}  // namespace astro::experiment
