#include "host/commands/shared/unused_choices.hpp"

#include <algorithm>
#include <functional>
#include <string>

#include "host/console/wrong_usage.hpp"
#include "host/formats/files/bag.hpp"

namespace astro::commands {
namespace {

namespace fs = std::filesystem;
using Files = std::vector<fs::path>;

bool is_missing(const fs::path& path) {
  std::error_code ignored;
  return !fs::exists(path, ignored);
}

bool any_bag(const Files& files) {
  return std::ranges::any_of(files,
                             [](const fs::path& path) { return is_missing(path) || bag::is_bag(path); });
}

bool any_text(const Files& files) {
  return std::ranges::any_of(files,
                             [](const fs::path& path) { return is_missing(path) || !bag::is_bag(path); });
}

/// --joints does not apply to a recording of ours, which contains the wheels, unless a topic is named.
bool any_bag_of_others(const ImportOptions& options) {
  return std::ranges::any_of(options.wheels, [&](const fs::path& path) {
    return is_missing(path) ||
           (bag::is_bag(path) && (!options.wheels_topic.empty() || !importing::is_own_recording(path)));
  });
}

bool has_controllers(const fs::path& path) {
  return !path.empty() && (is_missing(path) || importing::is_controller_file(path));
}

struct Choice {
  const char* name;
  bool given;
  std::function<bool(const ImportOptions&)> applies;
  const char* otherwise;
};

std::vector<Choice> choices_in(const ImportOptions& options) {
  constexpr const char *kNoTable = "none of the files of wheels is a table",
                       *kNoBagOfWheels = "none of the files of wheels is a bag of another program",
                       *kNoBagOfPoses = "none of the files of ground truth is a bag";
  const auto others = [](const ImportOptions& all) { return any_text(all.wheels) || any_bag_of_others(all); };
  const auto tables = [](const ImportOptions& all) { return any_text(all.wheels); };
  const auto bags_of_wheels = [](const ImportOptions& all) { return any_bag(all.wheels); };
  const auto bags_of_poses = [](const ImportOptions& all) { return any_bag(all.truth); };
  const auto takes = [](const ImportOptions& all) { return any_text(all.truth); };
  const auto controllers = [](const ImportOptions& all) { return has_controllers(all.robot_file); };
  const auto always = [](const ImportOptions&) { return true; };
  return {{"--wheel-columns", !options.table.columns.empty(), tables, kNoTable},
          {"--per-interval", options.table.per_interval, tables, kNoTable},
          {"--counter-range", options.table.counter_range.has_value(), others,
           "the files of wheels are our own recordings"},
          {"--truth-columns", !options.truth_columns.empty(), takes, "no file of ground truth is a table"},
          {"--wheels-topic", !options.wheels_topic.empty(), bags_of_wheels, kNoBagOfWheels},
          {"--wheels-unit", !options.wheels_unit.empty(), bags_of_wheels, kNoBagOfWheels},
          {"--joints", !options.joints.empty(), any_bag_of_others, kNoBagOfWheels},
          {"--truth-topic", !options.truth_topic.empty(), bags_of_poses, kNoBagOfPoses},
          {"--truth-frames", !options.frames.empty(), bags_of_poses, kNoBagOfPoses},
          {"--body", !options.body.empty(), takes, "all files of ground truth are bags"},
          {"--controller", !options.controller.empty(), controllers,
           "no parameters of controllers (YAML) are named with --robot"},
          {"--up", !options.up.empty(), always, ""},
          {"--truth-unit", !options.unit.empty(), always, ""},
          {"--truth-mirrored", options.mirrored != ImportOptions().mirrored, always, ""},
          {"--robot", !options.robot_file.empty(), always, ""},
          {"--wheel-diameter", options.wheel_diameter_m.has_value(), always, ""},
          {"--counts-per-turn", options.counts_per_turn.has_value(), always, ""},
          {"--wheelbase", options.wheelbase_m.has_value(), always, ""},
          {"--swap-wheels", options.swap_wheels, always, ""},
          {"--reverse-wheels", options.reverse_wheels, always, ""},
          {"--drives-backward", options.drives_backward, always, ""}};
}

}  // namespace

void refuse_unused_choices(const ImportOptions& options) {
  for (const Choice& choice : choices_in(options))
    if (choice.given && !choice.applies(options))
      throw console::WrongUsage(std::string(choice.name) + " does not apply here: " + choice.otherwise);
}

void refuse_choices_without_drives(const ImportOptions& options) {
  for (const Choice& choice : choices_in(options))
    if (choice.given) throw console::WrongUsage(std::string(choice.name) + " goes with --wheels and --truth");
}

}  // namespace astro::commands
