#include "host/experiment/analysis/json.hpp"

#include <cmath>

#include "host/base/text/degrees.hpp"
#include "host/calibration/judgement/remarks.hpp"
#include "host/experiment/analysis/judgement_sentences.hpp"
#include "host/experiment/files/factors_json.hpp"
#include "host/experiment/files/method_names.hpp"

namespace astro::experiment {
namespace {

// "x_cg_cw_m": the flat keys of one direction.
void add_cluster(nlohmann::json& json, const calibration::ClusterSummary& cluster,
                 const std::string& direction) {
  json["x_cg_" + direction + "_m"] = number(cluster.x_cg_m);
  json["y_cg_" + direction + "_m"] = number(cluster.y_cg_m);
  json["theta_cg_" + direction + "_rad"] = number(cluster.theta_cg_rad);
  json["r_cg_" + direction + "_m"] = number(cluster.r_cg_m);
}

void add_squares(nlohmann::json& json, const calibration::ExperimentSummary& squares) {
  json["runs_cw"] = squares.cw.runs;
  json["runs_ccw"] = squares.ccw.runs;
  json["E_max_syst_m"] = squares.E_max_syst_m;
  add_cluster(json, squares.cw, "cw");
  add_cluster(json, squares.ccw, "ccw");
}

void add_end_poses(nlohmann::json& json, const calibration::Estimate& estimate) {
  json["side_m"] = estimate.side_m;
  json["alpha_deg"] = number(degrees(estimate.alpha_rad));
  json["beta_deg"] = number(degrees(estimate.beta_rad));
  json["R_m"] = number(estimate.radius_m);
  if (estimate.options.method == calibration::Method::umbmark)
    json["angles"] = calibration::name_of(estimate.options.angles);
  if (estimate.options.method == calibration::Method::extended) {
    json["formula"] = calibration::name_of(estimate.options.formula);
    json["alpha_Ed_deg"] = number(degrees(estimate.alpha_Ed_rad));
  }
}

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
  for (const Remark& remark : calibration::remarks(ml.estimate, ml.noise_given))
    json.push_back(remark.sentence);
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
  return {{"x_m", number(lever.x_m)}, {"y_m", number(lever.y_m)}, {"yaw_rad", number(lever.theta_rad)}};
}

nlohmann::json matrix_json(const calibration::FactorCovariance& covariance) {
  nlohmann::json rows = nlohmann::json::array();
  for (int i = 0; i < covariance.rows(); ++i)
    rows.push_back({covariance(i, 0), covariance(i, 1), covariance(i, 2), covariance(i, 3)});
  return rows;
}

nlohmann::json errors_json(const FactorErrors& se) {
  return {{"E_b", number(se.E_b)}, {"E_d", number(se.E_d)}, {"scale", number(se.scale)},
          {"c_R", number(se.c_r)}, {"c_L", number(se.c_l)}, {"b_m", number(se.b_m)},
          {"e", number(se.e)}};
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

/// The keys of maximum likelihood alone: covariance, lever arm, clock, noise, runs, motions, remarks.
nlohmann::json likelihood_json(const MlResult& ml) {
  const calibration::MlEstimate& estimate = ml.estimate;
  nlohmann::json json = {
      {"covariance", {{"of", {"c_R", "c_L", "b_m", "e"}}, {"matrix", matrix_json(estimate.covariance)}}},
      {"b_over_scale_m", estimate.factors.b_m / estimate.scale()},
      {"b_over_scale_se_m", number(estimate.se.b_over_scale_m)},
      {"clock_known", ml.options.clock_known},
      {"noise",
       {{"given", ml.noise_given},
        {"K_m", estimate.noise.K_m},
        {"sigma_xy_m", estimate.noise.sigma_xy_m},
        {"sigma_theta_rad", number(estimate.noise.sigma_theta_rad)}}},
      {"spacing_m", estimate.spacing_m},
      {"chi_square", number(estimate.chi_square)},
      {"degrees_of_freedom", estimate.degrees_of_freedom},
      {"dispersion", number(estimate.dispersion)},
      {"widening", number(estimate.widening)},
      {"iterations", estimate.iterations},
      {"curvature", {{"e", number(estimate.factors.e)}, {"standard_error", number(estimate.se.e)}}},
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

nlohmann::json held_out_json(const calibration::RunErrors& errors) {
  return {{"end_m", errors.final_m},
          {"heading_rad", number(errors.final_heading_rad)},
          {"path_m", number(errors.path_rms_m)}};
}

nlohmann::json held_out_json(const calibration::HeldOutErrors& errors) {
  return {{"end_m", number(errors.final_m)},
          {"heading_rad", number(errors.final_heading_rad)},
          {"path_m", number(errors.path_m)}};
}

/// The keys of scans alone.
nlohmann::json scans_json(const lidar::ScanCalibration& found) {
  const lidar::ScanCounts& counts = found.counts;
  nlohmann::json remarks = nlohmann::json::array();
  for (const Remark& remark : found.remarks) remarks.push_back(remark.sentence);
  return {
      {"covariance", {{"of", {"c_R", "c_L", "b_m", "e"}}, {"matrix", matrix_json(found.covariance)}}},
      {"scanner", lever_json({found.scanner.x_m, found.scanner.y_m, wrapped_rad(found.scanner.theta_rad)})},
      {"scanner_se", lever_json(found.scanner_se)},
      {"late_s", std::isfinite(found.late_se_s) ? number(found.late_s) : nlohmann::json()},
      {"late_se_s", number(found.late_se_s)},
      {"scans",
       {{"read", counts.scans},
        {"outside", counts.outside},
        {"matched", counts.matched},
        {"one_direction", counts.degenerate},
        {"unmatched", counts.unmatched},
        {"gaps", counts.gaps},
        {"slipped", counts.slipped}}},
      {"remarks", remarks}};
}

nlohmann::json judgement_json(const Calibration& calibration) {
  const calibration::CrossValidation& judgement = calibration.judgement;
  nlohmann::json drives = nlohmann::json::array();
  for (const calibration::HeldOutRun& run : judgement.runs)
    drives.push_back({{"name", run.found.name},
                      {"carried", held_out_json(run.in_use)},
                      {"new", held_out_json(run.found)},
                      {"gain", number(run.gain)}});
  nlohmann::json not_judged = nlohmann::json::array();
  for (const Remark& remark : judgement.not_judged) not_judged.push_back(remark.sentence);
  nlohmann::json json = {{"verdict", name_of(judgement.verdict)},
                         {"use", !advises_against(judgement.verdict)},
                         {"sentence", judgement_sentence(calibration)}};
  if (const lidar::ScanCalibration* scans = calibration.scans()) {
    const lidar::FactorChoice& choice = scans->choice;
    json.update({{"factors", choice.set.name},
                 {"pieces", choice.pieces},
                 {"piece_m", choice.piece_m},
                 {"gain", number(choice.gain)},
                 {"gain_se", number(choice.gain_se)},
                 {"rms_m", number(choice.rms_m)},
                 {"carried_rms_m", number(choice.loaded_rms_m)}});
    return json;
  }
  json.update({{"better_on", judgement.better_on()},
               {"carried", held_out_json(judgement.in_use())},
               {"new", held_out_json(judgement.found())},
               {"drives", drives},
               {"not_judged", not_judged}});
  return json;
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

nlohmann::json to_json(const Calibration& calibration) {
  nlohmann::json json = to_json(calibration.factors);
  json["method"] = calibration.method();
  json["E_d"] = calibration.E_d();
  json["E_b"] = calibration.E_b();
  json["scale"] = calibration.scale();
  json["standard_errors"] = errors_json(calibration.se);
  json["standard_errors_another_day"] = errors_json(calibration.se_another_day);
  json["drift"] = {{"E_d", calibration.drift.E_d},
                   {"scale", calibration.drift.scale},
                   {"b_over_scale", calibration.drift.b_over_scale},
                   {"e", calibration.drift.e},
                   {"days", calibration.drift.days}};
  // "carried" is the name of the loaded factors in the files of this format; a new name would be a new format.
  json["carried"] = to_json(calibration.loaded);
  if (calibration.squares) add_squares(json, *calibration.squares);
  if (const calibration::Estimate* estimate = calibration.end_poses()) add_end_poses(json, *estimate);
  if (calibration.line_scale) json["lines"] = calibration.line_scale->lines;
  if (calibration.truth_scale_sigma > 0)
    json["truth_scale"] = {{"measured", std::isfinite(calibration.truth_scale_sigma)},
                           {"standard_error", number(calibration.truth_scale_sigma)}};
  if (std::isfinite(calibration.loaded_scale_sigma))
    json["loaded_scale"] = {{"standard_error", calibration.loaded_scale_sigma},
                            {"errors_apart", calibration.loaded_scale_apart}};
  if (!calibration.left_out.empty()) json["left_out"] = calibration.left_out;
  if (calibration.misfit) json["misfit"] = calibration.misfit->sentence;
  if (const MlResult* ml = calibration.ml()) json.update(likelihood_json(*ml));
  if (const lidar::ScanCalibration* scans = calibration.scans()) json.update(scans_json(*scans));
  json["verdict"] = judgement_json(calibration);
  return json;
}

}  // namespace astro::experiment
