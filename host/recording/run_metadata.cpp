#include "host/recording/run_metadata.hpp"

#include <array>
#include <utility>

#include "host/base/error.hpp"
#include "host/base/text/numbers.hpp"
#include "host/base/text/sense.hpp"
#include "host/recording/recording_problem.hpp"

namespace astro::recording {
namespace {

constexpr int kFormat = 1;
constexpr std::string_view kParameterPrefix = "parameter.";

constexpr std::array<std::pair<std::string_view, std::string RunInfo::*>, 10> kTexts{{
    {"kind", &RunInfo::kind},
    {"phase", &RunInfo::phase},
    {"robot_name", &RunInfo::robot_name},
    {"robot_id", &RunInfo::robot_id},
    {"board", &RunInfo::board},
    {"firmware", &RunInfo::firmware},
    {"started_at", &RunInfo::started_at},
    {"truth_source", &RunInfo::truth_source},
    {"truth_clock", &RunInfo::truth_clock},
    {"truth_film", &RunInfo::truth_film},
}};

constexpr std::array<std::pair<std::string_view, double RunInfo::*>, 3> kNumbers{{
    {"size_m", &RunInfo::size_m},
    {"speed_mps", &RunInfo::speed_mps},
    {"truth_scale_sigma", &RunInfo::truth_scale_sigma},
}};

constexpr std::array<std::pair<std::string_view, std::optional<double> RunRecord::*>, 2> kHeadings{{
    {"first_odometry_heading_rad", &RunRecord::first_odometry_heading_rad},
    {"first_truth_heading_rad", &RunRecord::first_truth_heading_rad},
}};

/// Looks up values by key; its errors name the file.
class Entries {
 public:
  Entries(const bag::mcap::Map& map, const std::string& file) : map_(map), file_(file) {}

  const std::string* find(std::string_view key) const {
    const auto found = map_.find(std::string(key));
    return found == map_.end() ? nullptr : &found->second;
  }
  double number(std::string_view key, const std::string& text) const {
    if (const auto value = number_in(text)) return *value;
    bad(key, text);
  }
  int integer(std::string_view key, int otherwise) const {
    const std::string* text = find(key);
    if (text == nullptr) return otherwise;
    if (const auto value = integer_in(*text)) return *value;
    bad(key, *text);
  }
  [[noreturn]] void bad(std::string_view key, const std::string& text) const {
    throw Error(file_ + " has the run record entry " + std::string(key) + " = \"" + text +
                    "\", which makes no sense: the file was edited or damaged; record the run again",
                RecordingProblem::bad_entry, {file_, std::string(key)});
  }

 private:
  const bag::mcap::Map& map_;
  const std::string& file_;
};

constexpr std::string_view kNoDirection = "none";

std::optional<Sense> direction_in(const Entries& entries) {
  const std::string* text = entries.find("direction");
  if (text == nullptr || *text == kNoDirection) return {};
  const std::optional<Sense> direction = sense_named(*text);
  if (!direction) entries.bad("direction", *text);
  return direction;
}

}  // namespace

std::string run_name(const RunInfo& info) {
  std::string name = "run";
  if (!info.kind.empty()) name += " " + info.kind;
  if (info.direction) name += " " + std::string(name_of(*info.direction));
  if (info.index != 0) name += " " + std::to_string(info.index);
  return info.phase.empty() ? name : name + " (" + info.phase + ")";
}

bag::mcap::Map to_map(const RunRecord& record) {
  bag::mcap::Map map{
      {"format", std::to_string(kFormat)},
      {"direction", std::string(record.info.direction ? name_of(*record.info.direction) : kNoDirection)},
      {"index", std::to_string(record.info.index)}};
  for (const auto& [key, member] : kTexts) map[std::string(key)] = record.info.*member;
  for (const auto& [key, member] : kNumbers) map[std::string(key)] = to_text(record.info.*member);
  // Most recordings have these default values, so they are not written.
  if (record.info.truth_film.empty()) map.erase("truth_film");
  if (record.info.truth_scale_sigma == 0) map.erase("truth_scale_sigma");
  for (const auto& [key, member] : kHeadings) {
    if (record.*member) map[std::string(key)] = to_text(*(record.*member));
  }
  for (const auto& [name, value] : record.info.parameters) {
    map[std::string(kParameterPrefix) + name] = to_text(value);
  }
  return map;
}

RunRecord run_record(const bag::mcap::Map& map, const std::string& file) {
  const Entries entries(map, file);
  if (entries.integer("format", kFormat) > kFormat) {
    throw Error(file + " was written by a newer version of Astrolabe: update this program",
                RecordingProblem::of_newer_version, {file});
  }
  RunRecord record;
  record.info.direction = direction_in(entries);
  record.info.index = entries.integer("index", 0);
  for (const auto& [key, member] : kTexts) {
    if (const std::string* text = entries.find(key)) record.info.*member = *text;
  }
  for (const auto& [key, member] : kNumbers) {
    if (const std::string* text = entries.find(key)) record.info.*member = entries.number(key, *text);
  }
  for (const auto& [key, member] : kHeadings) {
    if (const std::string* text = entries.find(key)) record.*member = entries.number(key, *text);
  }
  for (const auto& [key, text] : map) {
    if (!key.starts_with(kParameterPrefix)) continue;
    record.info.parameters[key.substr(kParameterPrefix.size())] = entries.number(key, text);
  }
  return record;
}

}  // namespace astro::recording
