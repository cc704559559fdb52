#include <algorithm>
#include <stdexcept>

#include "tests/host/campaign/place.hpp"

namespace astro::campaign {
namespace {

constexpr const char* kFactors = "[parameters]\nc_R = 1.002\nc_L = 0.998\nb = 0.289\n";
constexpr const char* kRuns =
    "ex_mm,ey_mm,etheta_deg\n-75,-80,3.0\n-65,-90,3.1\n-85,-70,2.9\n-70,-85,3.0\n-80,-75,3.05\n";
constexpr const char* kOtherRuns =
    "ex_mm,ey_mm,etheta_deg\n178,-160,6.6\n188,-170,6.7\n168,-150,6.5\n183,-165,6.6\n173,-155,6.65\n";

void nothing(const Place&) {}

void do_or_throw(const Words& arguments) {
  const support::Outcome outcome = support::astrolabe(arguments);
  if (outcome.code != 0) throw std::runtime_error("the scenario cannot be prepared: " + outcome.err);
}

Words end_poses(const Place& place, const std::string& out) {
  return {"calibrate",   "end-poses",
          "--cw",        place.path("cw.csv"),
          "--ccw",       place.path("ccw.csv"),
          "--side",      "3",
          "--wheelbase", "0.29",
          "--out",       place.path(out)};
}

void give_end_poses(const Place& place) {
  place.write("cw.csv", kRuns);
  place.write("ccw.csv", kOtherRuns);
}

void give_runs(const Place& place) {
  do_or_throw({"record", "--squares", "2", "--side", "0.3", "--truth", "sim", "--out", place.path("runs"),
               "--port", place.port()});
}

/// So far from what tuning measures that none of them can be what is loaded.
void give_wrong_motors(const Place& place) {
  do_or_throw({"params", "set", "kp=45", "ki=900", "kS_left=0.4", "kS_right=0.4", "kV_left=11.5",
               "kV_right=11.5", "kA_left=0.9", "kA_right=0.9", "--yes", "--port", place.port()});
}

std::vector<Scenario> make() {
  using Robot = Scenario::Robot;
  return {
      {"upload", [](const Place& place) { place.write("calib.toml", kFactors); },
       [](const Place& place) {
         return Words{"upload", place.path("calib.toml"), "--yes"};
       },
       true, nullptr, Robot::old_or_new},
      {"params_set", nothing,
       [](const Place&) { return Words{"params", "set", "c_R=1.002", "kp=50", "b=0.289", "--yes"}; }, true,
       nullptr, Robot::old_or_new},
      {"params_import",
       [](const Place& place) {
         place.write("set.toml", "[parameters]\nkp = 50.0\nb = 0.289\nrobot_name = \"New\"\n");
       },
       [](const Place& place) {
         return Words{"params", "import", place.path("set.toml"), "--yes"};
       },
       true, nullptr, Robot::old_or_new},
      {"params_defaults",
       [](const Place& place) {
         do_or_throw({"params", "set", "c_R=1.002", "kp=50", "b=0.289", "--yes", "--port", place.port()});
       },
       [](const Place&) {
         return Words{"params", "defaults", "--yes"};
       },
       true, nullptr, Robot::old_or_new},
      {"params_export", [](const Place& place) { place.write("set.toml", kFactors); },
       [](const Place& place) {
         return Words{"params", "export", place.path("set.toml")};
       },
       true, "set.toml"},
      {"drive", nothing,
       [](const Place&) {
         return Words{"drive", "square", "0.3"};
       }},
      {"drive_record", nothing,
       [](const Place& place) {
         return Words{"drive", "square", "0.3", "--record", place.path("run.mcap")};
       }},
      {"record", nothing,
       [](const Place& place) {
         return Words{"record", "--seconds", "0.2", "--truth", "sim", "--out", place.path("run.mcap")};
       }},
      {"record_programme", nothing,
       [](const Place& place) {
         return Words{"record",  "--lines", "1",       "--spins", "1",     "--length",        "0.3",
                      "--turns", "1",       "--truth", "sim",     "--out", place.path("runs")};
       }},
      {"umbmark", nothing,
       [](const Place& place) {
         return Words{"umbmark", "--runs",  "1",   "--side", "0.5",          "--no-extras",
                      "--yes",   "--truth", "sim", "--out",  place.path("x")};
       },
       true, nullptr, Robot::calibrated},
      {"tune", give_wrong_motors,
       [](const Place& place) {
         return Words{"tune", "--on-ground", "--yes", "--upload", "--out", place.path("tune.html")};
       },
       true, nullptr, Robot::tuned},
      {"calibrate_end_poses",
       [](const Place& place) {
         give_end_poses(place);
         place.write("calib.toml", kFactors);
       },
       [](const Place& place) { return end_poses(place, "calib.toml"); }, false, "calib.toml"},
      {"calibrate_runs",
       [](const Place& place) {
         give_runs(place);
         place.write("calib.toml", kFactors);
       },
       [](const Place& place) {
         return Words{"calibrate", "runs", place.path("runs"), "--out", place.path("calib.toml")};
       },
       false},
      {"calibrate_export",
       [](const Place& place) {
         give_end_poses(place);
         do_or_throw(end_poses(place, "calib.toml"));
         place.write("robot.yaml", "# Found by Astrolabe\nold: yes\n");
       },
       [](const Place& place) {
         return Words{"calibrate",      "export", place.path("calib.toml"), "--to", place.path("robot.yaml"),
                      "--wheel-radius", "0.036"};
       },
       false, "robot.yaml"},
      {"report",
       [](const Place& place) {
         give_runs(place);
         std::filesystem::create_directory(place.path("more"));
         for (const auto& entry : std::filesystem::directory_iterator(place.path("runs")))
           std::filesystem::copy(entry.path(), place.path("more") / entry.path().filename());
         do_or_throw({"report", place.path("runs"), place.path("more"), "--out", place.path("report.html")});
       },
       [](const Place& place) {
         return Words{"report", place.path("runs"), place.path("more"), "--out", place.path("report.html")};
       },
       false},
      {"study_shard", [](const Place& place) { place.write("part.json", "{\"methods\": \"old\"}\n"); },
       [](const Place& place) {
         return Words{"study",
                      "--runs",
                      "1",
                      "--side",
                      "0.5",
                      "--trials",
                      "4",
                      "--shard",
                      "1/2",
                      "--out",
                      place.path("part.json")};
       },
       false, "part.json"},
  };
}

}  // namespace

const std::vector<Scenario>& scenarios() {
  static const std::vector<Scenario> all = make();
  return all;
}

const Scenario& scenario(const std::string& name) {
  const auto found = std::ranges::find(scenarios(), name, &Scenario::name);
  if (found == scenarios().end()) throw std::runtime_error("no scenario " + name);
  return *found;
}

}  // namespace astro::campaign
