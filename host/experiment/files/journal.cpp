#include "host/experiment/files/journal.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "host/base/error.hpp"
#include "host/base/files.hpp"
#include "host/base/text/json_weight.hpp"
#include "host/experiment/files/factors_json.hpp"

namespace astro::experiment {
namespace {

constexpr int kFormat = 2;  // 1 meant end poses by "auto"

std::filesystem::path file_in(const std::filesystem::path& folder) { return folder / "experiment.json"; }

[[noreturn]] void fail_no_experiment(const std::filesystem::path& folder) {
  if (std::filesystem::exists(folder / "wall.json"))
    throw Error(fmt::format(
        "'{}' holds a calibration against a wall, which has no runs to report on{}", folder.string(),
        std::filesystem::exists(folder / "calib.toml")
            ? fmt::format(": what came out of it is in '{}'", (folder / "calib.toml").string())
            : ""));
  const std::string why = !std::filesystem::exists(folder) ? "does not exist"
                          : !std::filesystem::is_directory(folder)
                              ? "is a file"
                              : "holds no experiment (no experiment.json)";
  throw Error(fmt::format("'{}' {}", folder.string(), why), JournalProblem::no_experiment);
}

/// Refuses a plan that this program cannot have written, because its counts decide how much memory is used.
Plan drivable_plan(const nlohmann::json& json, const Remark& damaged) {
  try {
    const Plan plan = json.get<Plan>();
    plan.check();
    return plan;
  } catch (const Error& error) {
    Remark why = damaged;
    why.sentence += std::string(" (") + error.what() + ")";
    why.values.insert(why.values.end(), error.values().begin(), error.values().end());
    throw Error(why);
  }
}

}  // namespace

bool has_journal(const std::filesystem::path& folder) { return std::filesystem::exists(file_in(folder)); }

Journal read_journal(const std::filesystem::path& folder) {
  const std::filesystem::path path = file_in(folder);
  if (!std::filesystem::exists(path)) fail_no_experiment(folder);
  const Bytes bytes = load_file(path, kMaxSettingsBytes);
  const Remark damaged{"'" + path.string() + "' is damaged", JournalProblem::damaged, {path.string()}};
  if (!json_fits_memory(as_text(bytes))) throw Error(damaged);
  try {
    const auto json = nlohmann::json::parse(bytes.begin(), bytes.end());
    if (json.at("format") != kFormat)
      throw Error("'" + path.string() +
                  "' was written by another version of Astrolabe: use that one to go on with it");
    Journal journal;
    journal.plan = drivable_plan(json.at("plan"), damaged);
    const auto& robot = json.at("robot");
    robot.at("id").get_to(journal.robot_id);
    robot.at("name").get_to(journal.robot_name);
    robot.at("board").get_to(journal.board);
    robot.at("firmware").get_to(journal.firmware);
    json.at("started_at").get_to(journal.started_at);
    // "carried" is the name of the loaded factors in the files of this format.
    for (const auto& [phase, loaded] : json.at("carried").items()) journal.loaded[phase] = factors_in(loaded);
    journal.confirmed = json.value("confirmed", journal.confirmed);  // older versions have none
    return journal;
  } catch (const nlohmann::json::exception&) {
    throw Error(damaged);
  }
}

void write_journal(const std::filesystem::path& folder, const Journal& journal) {
  nlohmann::json loaded = nlohmann::json::object();
  for (const auto& [phase, factors] : journal.loaded) loaded[phase] = to_json(factors);
  const nlohmann::json json = {{"format", kFormat},
                               {"started_at", journal.started_at},
                               {"plan", journal.plan},
                               {"robot",
                                {{"id", journal.robot_id},
                                 {"name", journal.robot_name},
                                 {"board", journal.board},
                                 {"firmware", journal.firmware}}},
                               {"carried", loaded},
                               {"confirmed", journal.confirmed}};
  // Texts of a robot may not be valid UTF-8.
  const std::string text = json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
  PartFile file(file_in(folder));
  file.write({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  file.commit();
}

}  // namespace astro::experiment
