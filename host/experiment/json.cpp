#include "host/experiment/json.hpp"

#include <cmath>
#include <numbers>

namespace astro::experiment {
namespace {

double degrees(double radians) { return radians * 180 / std::numbers::pi; }

// "x_cg_cw_m": the flat keys of one direction.
void add_cluster(nlohmann::json& json, const calibration::ClusterSummary& cluster,
                 const std::string& direction) {
  json["x_cg_" + direction + "_m"] = number(cluster.x_cg_m);
  json["y_cg_" + direction + "_m"] = number(cluster.y_cg_m);
  json["theta_cg_" + direction + "_rad"] = number(cluster.theta_cg_rad);
  json["r_cg_" + direction + "_m"] = number(cluster.r_cg_m);
}

}  // namespace

nlohmann::json number(double value) {
  return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json();
}

nlohmann::json to_json(const calibration::ClusterSummary& cluster) {
  return {{"runs", cluster.runs},
          {"x_cg_m", number(cluster.x_cg_m)},
          {"y_cg_m", number(cluster.y_cg_m)},
          {"theta_cg_rad", number(cluster.theta_cg_rad)},
          {"r_cg_m", number(cluster.r_cg_m)},
          {"se_x_m", number(cluster.se_x_m)},
          {"se_y_m", number(cluster.se_y_m)},
          {"se_theta_rad", number(cluster.se_theta_rad)},
          {"se_r_m", number(cluster.se_r_m)},
          {"rms_x_m", number(cluster.rms_x_m)},
          {"rms_y_m", number(cluster.rms_y_m)},
          {"rms_r_m", number(cluster.rms_r_m)},
          {"rms_theta_rad", number(cluster.rms_theta_rad)}};
}

nlohmann::json to_json(const calibration::ExperimentSummary& summary) {
  return {{"E_max_syst_m", number(summary.E_max_syst_m)},
          {"se_E_max_syst_m", number(summary.se_E_max_syst_m)},
          {"cw", to_json(summary.cw)},
          {"ccw", to_json(summary.ccw)}};
}

nlohmann::json to_json(const calibration::Estimate& estimate) {
  nlohmann::json json = {
      {"method", calibration::name_of(estimate.options.method)},
      {"side_m", estimate.side_m},
      {"alpha_deg", number(degrees(estimate.alpha_rad))},
      {"beta_deg", number(degrees(estimate.beta_rad))},
      {"R_m", number(estimate.radius_m)},
      {"E_b", estimate.E_b},
      {"E_d", estimate.E_d},
      {"c_R", estimate.factors.c_r},
      {"c_L", estimate.factors.c_l},
      {"b_m", estimate.factors.b_m},
      {"standard_errors",
       {{"E_b", number(estimate.se.E_b)},
        {"E_d", number(estimate.se.E_d)},
        {"c_R", number(estimate.se.c_r)},
        {"c_L", number(estimate.se.c_l)},
        {"b_m", number(estimate.se.b_m)}}},
      {"carried",
       {{"c_R", estimate.carried.c_r}, {"c_L", estimate.carried.c_l}, {"b_m", estimate.carried.b_m}}},
      {"runs_cw", estimate.summary.cw.runs},
      {"runs_ccw", estimate.summary.ccw.runs},
      {"E_max_syst_m", estimate.summary.E_max_syst_m}};
  if (estimate.options.method == calibration::Method::umbmark)
    json["angles"] = calibration::name_of(estimate.options.angles);
  if (estimate.options.method == calibration::Method::extended) {
    json["formula"] = calibration::name_of(estimate.options.formula);
    json["alpha_Ed_deg"] = number(degrees(estimate.alpha_Ed_rad));
  }
  add_cluster(json, estimate.summary.cw, "cw");
  add_cluster(json, estimate.summary.ccw, "ccw");
  return json;
}

}  // namespace astro::experiment
