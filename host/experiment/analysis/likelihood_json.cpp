#include "host/experiment/analysis/likelihood_json.hpp"

#include "host/calibration/judgement/remarks.hpp"
#include "host/experiment/analysis/json.hpp"
#include "host/experiment/files/method_names.hpp"

namespace astro::experiment {
namespace {

nlohmann::json slip_events_json(const std::vector<calibration::SlipEvent>& slip_events) {
  nlohmann::json json = nlohmann::json::array();
  for (const calibration::SlipEvent& event : slip_events)
    json.push_back({{"time_s", event.time_s},
                    {"since_start_s", event.since_start_s},
                    {"turned_rad", event.turned_rad},
                    {"moved_m", event.moved_m}});
  return json;
}

nlohmann::json remark_facts(const MlResult& ml) {
  nlohmann::json json = nlohmann::json::array();
  for (const Remark& remark : calibration::remarks(ml.estimate, ml.options.noise.has_value()))
    json.push_back(remark.fact);
  return json;
}

nlohmann::json run_json(const calibration::RunFit& run) {
  return {{"name", run.name},
          {"distance_m", run.distance_m},
          {"rotation_rad", run.rotation_rad},
          {"clock_offset_s", number(run.clock_offset_s)},
          {"clock_offset_se_s", number(run.clock_offset_se_s)},
          {"chi_square", number(run.chi_square)},
          {"degrees_of_freedom", run.degrees_of_freedom},
          {"session", run.session},
          {"disagreement", number(run.disagreement)},
          {"disagreement_dof", run.disagreement_dof},
          {"outlier", run.outlier},
          // "jolts" is the name of slip events in the files of this format.
          {"jolts", slip_events_json(run.slip_events)}};
}

nlohmann::json kind_json(const calibration::KindFit& kind) {
  return {{"motion", name_of(kind.motion)},
          {"samples", kind.samples},
          {"distance_m", kind.distance_m},
          {"rotation_rad", kind.rotation_rad},
          {"rms_xy_m", number(kind.rms_xy_m)},
          {"rms_theta_rad", number(kind.rms_theta_rad)},
          {"chi_square_per_dof", number(kind.chi_square_per_dof)}};
}

nlohmann::json lever_json(const calibration::LeverArm& lever) {
  return {{"x_m", number(lever.x_m)}, {"y_m", number(lever.y_m)}, {"yaw_rad", number(lever.yaw_rad)}};
}

nlohmann::json matrix_json(const calibration::FactorCovariance& covariance) {
  nlohmann::json rows = nlohmann::json::array();
  for (int i = 0; i < covariance.rows(); ++i)
    rows.push_back({covariance(i, 0), covariance(i, 1), covariance(i, 2), covariance(i, 3)});
  return rows;
}

nlohmann::json curvature_json(const std::optional<calibration::CurvatureEffect>& curvature) {
  if (!curvature) return {};
  return {{"e", number(curvature->e)},
          {"standard_error", number(curvature->standard_error)},
          {"estimated", curvature->estimated}};
}

nlohmann::json eccentricity_json(const calibration::Eccentricity& wheel) {
  return {{"amplitude_m", number(wheel.amplitude_m)},
          {"standard_error_m", number(wheel.standard_error_m)},
          {"phases_rad", wheel.phases_rad},
          {"significant", wheel.significant}};
}

nlohmann::json session_json(const std::string& name, const calibration::SessionFit& session) {
  return {{"name", name.empty() ? nlohmann::json() : nlohmann::json(name)},
          {"lever_arm", lever_json(session.lever)},
          {"lever_arm_se", lever_json(session.lever_se)},
          {"clock_skew", number(session.clock_skew)},
          {"clock_skew_se", number(session.clock_skew_se)}};
}

}  // namespace

nlohmann::json to_json(const MlResult& ml) {
  const calibration::MlEstimate& estimate = ml.estimate;
  nlohmann::json json = {
      {"covariance", {{"of", {"c_R", "c_L", "b_m", "e"}}, {"matrix", matrix_json(estimate.covariance)}}},
      {"b_over_scale_m", estimate.factors.b_m / estimate.scale()},
      {"b_over_scale_se_m", number(estimate.se.b_over_scale_m)},
      {"clock_known", ml.options.clock_known},
      {"noise",
       {{"given", ml.options.noise.has_value()},
        {"K_m", estimate.noise.K_m},
        {"sigma_xy_m", estimate.noise.sigma_xy_m},
        {"sigma_theta_rad", number(estimate.noise.sigma_theta_rad)}}},
      {"spacing_m", estimate.spacing_m},
      {"chi_square", number(estimate.chi_square)},
      {"degrees_of_freedom", estimate.degrees_of_freedom},
      {"dispersion", number(estimate.dispersion)},
      {"widening", number(estimate.widening)},
      {"iterations", estimate.iterations},
      {"curvature", curvature_json(estimate.curvature)},
      {"eccentricity",
       {{"left", eccentricity_json(estimate.eccentricities.left)},
        {"right", eccentricity_json(estimate.eccentricities.right)}}},
      {"remarks", remark_facts(ml)}};
  json["sessions"] = nlohmann::json::array();
  for (std::size_t i = 0; i < estimate.sessions.size(); ++i)
    json["sessions"].push_back(
        session_json(i < ml.session_names.size() ? ml.session_names[i] : "", estimate.sessions[i]));
  json["runs"] = nlohmann::json::array();
  for (const calibration::RunFit& run : estimate.runs) json["runs"].push_back(run_json(run));
  json["motions"] = nlohmann::json::array();
  for (const calibration::KindFit& kind : estimate.kinds) json["motions"].push_back(kind_json(kind));
  return json;
}

}  // namespace astro::experiment
