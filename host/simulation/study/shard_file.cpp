#include "host/simulation/study/shard_file.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "host/base/error.hpp"
#include "host/base/text/json_weight.hpp"
#include "host/base/text/numbers.hpp"

namespace astro::simulation::study {
namespace {

using nlohmann::json;

constexpr const char* kFormat = "astrolabe study 3";

// JSON has no NaN and no infinity; its writer would write null, which here means that a method gave no
// answer.
json to_json(double value) {
  if (std::isfinite(value)) return value;
  return std::isnan(value) ? "nan" : value > 0 ? "inf" : "-inf";
}

double number_from(const json& value) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  if (value == "nan") return std::numeric_limits<double>::quiet_NaN();
  if (value == "inf") return kInfinity;
  if (value == "-inf") return -kInfinity;
  return value.get<double>();
}

json to_json(const Errors& errors) {
  json list = json::array();
  for (const double error : errors) list.push_back(to_json(error));
  return list;
}

Errors errors_from(const json& value) {
  Errors errors{};
  for (std::size_t f = 0; f < kFigures; ++f) errors[f] = number_from(value.at(f));
  return errors;
}

json to_json(const Trial& trial) {
  json errors = json::array();
  for (const auto& answer : trial.errors) errors.push_back(answer ? to_json(*answer) : json());
  return {{"trial", trial.index},
          {"errors", errors},
          {"ml_chi_square", trial.ml_chi_square ? to_json(*trial.ml_chi_square) : json()},
          {"ml_unknowns", trial.ml_unknowns},
          {"ml_K_m", trial.ml_K_m ? to_json(*trial.ml_K_m) : json()},
          {"failure", trial.failure}};
}

Trial trial_from(const json& value) {
  Trial trial;
  trial.index = count_in(value.at("trial").dump(), "trial");
  value.at("failure").get_to(trial.failure);
  const json& errors = value.at("errors");
  for (std::size_t i = 0; i < trial.errors.size(); ++i)
    if (!errors.at(i).is_null()) trial.errors[i] = errors_from(errors.at(i));
  if (const json& square = value.at("ml_chi_square"); !square.is_null())
    trial.ml_chi_square = number_from(square);
  trial.ml_unknowns = count_in(value.at("ml_unknowns").dump(), "ml_unknowns");
  if (const json& slip = value.at("ml_K_m"); !slip.is_null()) trial.ml_K_m = number_from(slip);
  return trial;
}

void require_same(const ShardFile& first, const ShardFile& other) {
  const json a = to_json(first.setup), b = to_json(other.setup);
  for (const auto& [key, value] : a.items())
    if (b.at(key) != value)
      throw Error("'" + first.name + "' was made with " + key + " " + value.dump() + " and '" + other.name +
                      "' with " + b.at(key).dump() + ": merge shards of one study only",
                  StudyProblem::of_two_studies,
                  {first.name, key, value.dump(), other.name, b.at(key).dump()});
}

struct SourcedTrial {
  const ShardFile* part;
  const Trial* trial;
  int index() const { return trial->index; }
};

/// Stable, so that if a trial is in two files, the one of the file named first comes first. Allocates memory
/// for the trials that exist, not for the number that a file claims.
std::vector<SourcedTrial> sorted_by_index(const std::vector<ShardFile>& parts) {
  std::vector<SourcedTrial> held;
  for (const ShardFile& part : parts) {
    require_same(parts.front(), part);
    for (const Trial& trial : part.trials) held.push_back({&part, &trial});
  }
  std::stable_sort(held.begin(), held.end(),
                   [](const SourcedTrial& a, const SourcedTrial& b) { return a.index() < b.index(); });
  return held;
}

[[noreturn]] void refuse_as_none(const std::string& name) {
  throw Error("'" + name + "' is not a shard of a study", StudyProblem::not_a_shard, {name});
}

[[noreturn]] void refuse_gap(int count, int begin, int end) {
  const std::string which = end - begin == 1
                                ? "number " + std::to_string(begin) + " is"
                                : std::to_string(begin) + " to " + std::to_string(end - 1) + " are";
  throw Error(
      "of " + std::to_string(count) + " trials " + which + " missing: run the shard, or name its file, too",
      StudyProblem::trials_missing, {std::to_string(count), std::to_string(begin), std::to_string(end - 1)});
}

[[noreturn]] void refuse_twice(const SourcedTrial& trial, const SourcedTrial& before) {
  throw Error("trial " + std::to_string(trial.index()) + " is in '" + before.part->name + "' and in '" +
                  trial.part->name + "': name each shard once",
              StudyProblem::trial_twice,
              {std::to_string(trial.index()), before.part->name, trial.part->name});
}

}  // namespace

std::string to_text(const TrialSetup& setup, const std::vector<Trial>& trials) {
  json list = json::array();
  for (const Trial& trial : trials) list.push_back(to_json(trial));
  return json{{"format", kFormat}, {"methods", kMethods}, {"setup", to_json(setup)}, {"trials", list}}.dump(
             1) +
         "\n";
}

ShardFile read_shard_file(const std::string& text, const std::string& name) {
  if (!json_fits_memory(text)) refuse_as_none(name);
  try {
    const json file = json::parse(text);
    if (file.at("format") != kFormat || file.at("methods") != json(kMethods))
      throw Error("'" + name + "' was written by another version of the study",
                  StudyProblem::shard_of_other_version, {name});
    ShardFile part{name, setup_from(file.at("setup")), {}};
    for (const json& trial : file.at("trials")) part.trials.push_back(trial_from(trial));
    part.setup.check();
    return part;
  } catch (const json::exception&) {
    refuse_as_none(name);
  }
}

std::vector<Trial> merge(const std::vector<ShardFile>& parts) {
  if (parts.empty())
    throw Error("there is nothing to merge: name the files of all shards", StudyProblem::no_shards);
  const int count = parts.front().setup.trials;
  const std::vector<SourcedTrial> held = sorted_by_index(parts);
  int next = 0;
  for (const SourcedTrial& trial : held) {
    if (trial.index() < 0 || trial.index() >= count)
      throw Error("'" + trial.part->name + "' holds trial " + std::to_string(trial.index()) +
                      " of a study of " + std::to_string(count) + "; it is damaged",
                  StudyProblem::shard_damaged,
                  {trial.part->name, std::to_string(trial.index()), std::to_string(count)});
    if (trial.index() < next) refuse_twice(trial, held[static_cast<std::size_t>(next) - 1]);
    if (trial.index() > next) refuse_gap(count, next, trial.index());
    ++next;
  }
  if (next < count) refuse_gap(count, next, count);
  std::vector<Trial> all;
  all.reserve(held.size());
  for (const SourcedTrial& trial : held) all.push_back(*trial.trial);
  return all;
}

}  // namespace astro::simulation::study
