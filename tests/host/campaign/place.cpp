#include "tests/host/campaign/place.hpp"

#include <gmock/gmock.h>

#include <fstream>
#include <random>

#include "host/base/files.hpp"
#include "host/experiment/analysis/calibration_file.hpp"
#include "host/recording/run_file.hpp"
#include "tests/support/base/json.hpp"

namespace astro::campaign {

namespace fs = std::filesystem;
using support::astrolabe;
using support::Outcome;

void Place::write(const std::string& name, const std::string& text) const {
  std::ofstream(path(name)) << text;
}

namespace {

std::string text_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

std::string Place::read(const std::string& name) const { return text_of(path(name)); }

ParameterSet Place::parameters() const {
  const Outcome outcome = astrolabe({"params", "list", "--json", "--port", port()});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  ParameterSet set;
  for (const auto& row : support::parse_json(outcome.out)) set[row.at("name")] = row.at("value").dump();
  return set;
}

void Place::expect_outputs_off() const {
  constexpr int kSilence_ms =
      3500;  // after 3 s without a word from any host the outputs are off; a look is a word
  std::string mode;
  EXPECT_TRUE(support::eventually([&] {
    const Outcome outcome = astrolabe({"info", "--json", "--port", port()});
    if (outcome.code == 0) mode = support::parse_json(outcome.out).at("mode");
    if (mode == "disarmed" || mode == "fault") return true;
    poll(nullptr, 0, kSilence_ms);
    return false;
  })) << mode;
}

namespace {

// A recording of which not even the first chunk is complete holds its header, its description and less than
// two seconds.
constexpr std::uintmax_t kBeforeFirstChunk = 64 * 1024;

void expect_readable(const fs::path& file) {
  const bool is_part = file.extension() == ".part";
  try {
    const recording::Run run = recording::run_from_bytes(load_file(file), file.string());
    // Between its last byte and its name a recording is whole and yet called unfinished.
    EXPECT_TRUE(!run.warning || is_part) << file << run.warning->sentence;
  } catch (const std::exception& error) {
    EXPECT_TRUE(is_part && fs::file_size(file) < kBeforeFirstChunk) << file << ": " << error.what();
  }
}

Words joined(Words words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

/// The names of those that differ.
Words changed(const ParameterSet& a, const ParameterSet& b) {
  Words names;
  for (const auto& [name, value] : a)
    if (!b.contains(name) || b.at(name) != value) names.push_back(name);
  return names;
}

// A calibration differs from drive to drive; what the robot carries must be what the file says, all of it.
void expect_calibrated_or_old(const Place& place, const ParameterSet& old, const ParameterSet& now) {
  ParameterSet others = now;
  for (const char* const name : {"c_R", "c_L", "b", "e"}) others[name] = old.at(name);
  EXPECT_EQ(others, old) << "only the factors change";
  if (now == old) return;
  bool found = false;
  for (const auto& entry : fs::recursive_directory_iterator(place.folder())) {
    if (entry.path().extension() != ".toml") continue;
    // Values that the robot holds already are no change.
    const Outcome again =
        astrolabe({"upload", entry.path().string(), "--yes", "--force", "--port", place.port()});
    found = found || (again.code == 0 && again.err.find("already") != std::string::npos);
  }
  EXPECT_TRUE(found) << "the robot carries factors of no calibration: " << now.at("c_R") << ' '
                     << now.at("c_L") << ' ' << now.at("b");
}

}  // namespace

Outcome run(const Words& command) {
  support::Program program(command);
  const int code = program.wait();
  return {code, program.out(), program.err()};
}

void expect_whole_files(const std::string& folder) {
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    const std::string name = entry.path().filename().string();
    if (name.ends_with(".mcap") || name.ends_with(".mcap.part")) expect_readable(entry.path());
    if (name.ends_with(".html")) {
      EXPECT_THAT(text_of(entry.path()), testing::EndsWith("</html>\n")) << name;
    } else if (name.ends_with(".json")) {
      EXPECT_TRUE(nlohmann::json::accept(text_of(entry.path()))) << name;
    } else if (name.ends_with(".toml")) {
      EXPECT_NO_THROW(experiment::read_parameter_file(entry.path())) << name;
    }
  }
}

Words Scenario::command(const Place& place) const {
  Words words = joined({ASTROLABE_PROGRAM}, arguments(place));
  return needs_robot ? joined(words, {"--port", place.port()}) : words;
}

const Reference& reference(const Scenario& scenario) {
  static std::map<std::string, Reference> known;
  const auto found = known.find(scenario.name);
  if (found != known.end()) return found->second;
  const Place place;
  scenario.prepare(place);
  Reference& made = known[scenario.name];
  made.old_parameters = place.parameters();
  if (scenario.replaces != nullptr) made.old_file = place.read(scenario.replaces);
  const support::TracedOutcome outcome = support::run_traced(scenario.command(place), place.folder(), {});
  if (outcome.code != 0)
    throw std::runtime_error(scenario.name + " does not even run undisturbed: " + outcome.err);
  made.calls = outcome.calls;
  made.new_parameters = place.parameters();
  if (scenario.replaces != nullptr) made.new_file = place.read(scenario.replaces);
  return made;
}

void expect_old_or_new(const Scenario& scenario, const Place& place, bool ended_well) {
  const Reference& known = reference(scenario);
  if (scenario.needs_robot) place.expect_outputs_off();
  const ParameterSet now = place.parameters();
  switch (scenario.robot) {
    case Scenario::Robot::keeps:
      EXPECT_EQ(now, known.old_parameters);
      break;
    case Scenario::Robot::old_or_new:
      EXPECT_TRUE(now == known.new_parameters || (!ended_well && now == known.old_parameters))
          << "not old: " << testing::PrintToString(changed(now, known.old_parameters))
          << ", not new: " << testing::PrintToString(changed(now, known.new_parameters));
      break;
    case Scenario::Robot::calibrated:
      expect_calibrated_or_old(place, known.old_parameters, now);
      break;
    case Scenario::Robot::tuned:
      // Measured gains differ in their last digits from run to run; of a set that was loaded all differ from the old ones.
      if (now != known.old_parameters) {
        EXPECT_EQ(changed(now, known.old_parameters), changed(known.new_parameters, known.old_parameters));
      }
      break;
  }
  if (scenario.replaces != nullptr) {
    const std::string content = place.read(scenario.replaces);
    EXPECT_TRUE(content == known.new_file || (!ended_well && content == known.old_file))
        << scenario.replaces << " holds " << content.size() << " bytes, of old " << known.old_file.size()
        << ", of new " << known.new_file.size();
  }
  expect_whole_files(place.folder());
}

void expect_repeatable(const Scenario& scenario, const Place& place) {
  if (!scenario.repeats) return;
  const Outcome again = run(scenario.command(place));
  const bool is_done =
      again.err.find("already") != std::string::npos || again.err.find("exists") != std::string::npos;
  EXPECT_TRUE(again.code == 0 || is_done) << again.err;
  expect_old_or_new(scenario, place, true);
}

std::vector<std::size_t> spread(std::size_t count, std::size_t last, unsigned seed) {
  std::vector<std::size_t> numbers;
  std::mt19937 random(seed);
  count = std::min(count, last);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t from = i * last / count, to = (i + 1) * last / count;
    numbers.push_back(from + 1 + random() % (to - from));
  }
  return numbers;
}

}  // namespace astro::campaign
