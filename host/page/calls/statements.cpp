#include "host/page/calls/statements.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <span>

#include "host/base/error.hpp"
#include "host/page/calls/question.hpp"

namespace astro::page {
namespace {

using nlohmann::json;

std::optional<double> size_in(const json& question, const char* name, const importing::Limits& limits) {
  return number_in(question, name, limits.least, limits.most);
}

std::string one_of(const json& question, const char* name, std::span<const char* const> words) {
  std::string word = text_in(question, name);
  if (!word.empty() && std::ranges::find(words, word) == words.end())
    throw Error(fmt::format("{} is '{}', and must be one of {}", name, word, fmt::join(words, ", ")));
  return word;
}

void take_files(const json& question, const std::filesystem::path& folder, importing::StatedDrives& drives) {
  const auto found = question.find("drives");
  if (found == question.end()) return;
  if (!found->is_array()) throw Error("drives is no list");
  int number = 0;
  for (const json& drive : *found) {
    ++number;
    if (!drive.is_object()) throw Error("drives has an entry that is no object");
    const std::string wheels = text_in(drive, "wheels"), truth = text_in(drive, "truth");
    // The wheels of one drive and the truth of the next would be taken for a drive.
    if (found->size() > 1 && wheels.empty() != truth.empty())
      throw Error(fmt::format("drive {} has no {}", number, wheels.empty() ? "wheels" : "ground truth"));
    if (!wheels.empty()) drives.wheels.push_back(file_in(folder, wheels));
    if (!truth.empty()) drives.truth.push_back(file_in(folder, truth));
  }
}

}  // namespace

importing::StatedDrives statements_in(const json& question, const std::filesystem::path& folder) {
  importing::StatedDrives drives;
  take_files(question, folder, drives);
  drives.table.columns = text_in(question, "wheel_columns");
  drives.table.per_interval = flag_in(question, "per_interval");
  drives.table.counter_range = size_in(question, "counter_range", importing::kCounterRangeLimits);
  drives.wheels_topic = text_in(question, "wheels_topic");
  drives.wheels_unit = text_in(question, "wheels_unit");
  drives.truth_topic = text_in(question, "truth_topic");
  drives.truth_columns = text_in(question, "truth_columns");
  drives.body = text_in(question, "body");
  drives.up = text_in(question, "up");
  drives.unit = one_of(question, "truth_unit", importing::kTruthUnits);
  constexpr const char* kMirrored[] = {"yes", "no"};
  if (const std::string mirrored = one_of(question, "truth_mirrored", kMirrored); !mirrored.empty())
    drives.mirrored = mirrored;
  drives.controller = text_in(question, "controller");
  drives.joints = texts_in(question, "joints");
  drives.frames = texts_in(question, "truth_frames");
  drives.swap_wheels = flag_in(question, "swap_wheels");
  drives.reverse_wheels = flag_in(question, "reverse_wheels");
  drives.drives_backward = flag_in(question, "drives_backward");
  if (const std::string robot = text_in(question, "robot"); !robot.empty())
    drives.robot_file = file_in(folder, robot);
  drives.wheel_diameter_m = size_in(question, "wheel_diameter", importing::kWheelDiameterLimits_m);
  drives.counts_per_turn = size_in(question, "counts_per_turn", importing::kCountsPerTurnLimits);
  drives.wheelbase_m = size_in(question, "wheelbase", importing::kWheelbaseLimits_m);
  return drives;
}

}  // namespace astro::page
