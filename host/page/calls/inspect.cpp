#include "host/page/calls/inspect.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "host/base/error.hpp"
#include "host/import/drives/file_pairs.hpp"
#include "host/import/drives/stated_drives.hpp"
#include "host/import/wheels/travel_measure.hpp"
#include "host/page/calls/looked_file.hpp"
#include "host/page/calls/question.hpp"
#include "host/page/calls/statements.hpp"

namespace astro::page {
namespace {

using importing::StatedDrives;
using nlohmann::json;
namespace fs = std::filesystem;

/// What is stated of a robot's file that cannot be read is that file's problem, and no other file's.
importing::ImportChoices readable_choices(StatedDrives stated) try {
  return importing::choices_of(stated);
} catch (const Error&) {
  stated.robot_file.clear();
  stated.controller.clear();
  return importing::choices_of(stated);
}

json units() {
  json wheels = json::array();
  for (const importing::TravelMeasure& measure : importing::travel_measures()) wheels.push_back(measure.name);
  return {{"wheels", wheels}, {"truth", importing::kTruthUnits}};
}

json column_roles() {
  const json times = {"time", "time_s", "time_ms", "time_us", "time_ns", "time_cs"};
  json wheels = times;
  for (const char* side : {"left_", "right_"})
    for (const importing::TravelMeasure& measure : importing::travel_measures()) {
      std::string name = side + std::string(measure.name);
      std::ranges::replace(name, '/', '_');
      wheels.push_back(name);
    }
  json truth = times;
  for (const std::string unit : importing::kTruthUnits)
    for (const char* axis : {"x_", "y_", "z_"}) truth.push_back(std::string(axis) + unit);
  for (const char* unit : {"rad", "deg"})
    for (const char* angle : {"theta_", "roll_", "pitch_", "yaw_"})
      truth.push_back(std::string(angle) + unit);
  for (const char* part : {"qx", "qy", "qz", "qw"}) truth.push_back(part);
  return {{"wheels", wheels}, {"truth", truth}};
}

}  // namespace

json inspect(const json& question, const fs::path& folder, const Emit&) {
  const StatedDrives stated = statements_in(question, folder);
  const importing::ImportChoices choices = readable_choices(stated);
  const json roles = question.value("roles", json::object());
  if (!roles.is_object()) throw Error("roles is no object");
  json files = json::array(), drives = json::array();
  std::vector<importing::OfferedFile> offered;
  for (const std::string& name : texts_in(question, "files")) {
    const std::string role = text_in(roles, name.c_str());
    const LookedFile file(file_in(folder, name),
                          role.empty() ? std::nullopt : std::optional(role_named(role)), stated, choices);
    files.push_back(file.answer());
    offered.push_back(file.offered());
  }
  for (const importing::DriveFiles& drive : importing::pair_files(offered))
    drives.push_back(
        {{"wheels", drive.wheels.filename().string()}, {"truth", drive.truth.filename().string()}});
  return {{"files", files}, {"drives", drives}, {"roles", column_roles()}, {"units", units()}};
}

}  // namespace astro::page
