#include <memory>
#include <nlohmann/json.hpp>

#include "host/commands/base/flags.hpp"
#include "host/commands/shared/import_options.hpp"
#include "host/commands/shared/robot_view.hpp"
#include "host/commands/shared/unused_choices.hpp"
#include "host/commands/truth/commands.hpp"
#include "host/commands/truth/inspect_view.hpp"
#include "host/console/wrong_usage.hpp"

namespace astro::commands {

void add_inspect(console::Command app) {
  struct Options {
    std::filesystem::path file;
    ImportOptions choices;
    bool json = false;
  };
  const auto options = std::make_shared<Options>();
  const console::Command command =
      app.add_subcommand("inspect", "say what is in a file of a tracker, a robot or a ROS 2 bag");
  command.add_option("file", options->file, "the file, or the folder of a bag").required();
  add_table_choices(command, options->choices.table);
  command
      .add_option("--truth-topic", options->choices.truth_topic,
                  "bags: look at the poses of this topic: lost, gaps,\nup axis, noise at rest")
      .type_name("TOPIC");
  add_json_flag(command, options->json);
  command.footer(
      "Recognised by content: Motive CSV, Vicon CSV, TUM, EuRoC, CSV with names and units (also packed with\n"
      "gzip); bags (.mcap, .db3, folders); tables of wheels. By the end of its name: sizes of a robot "
      "(.toml, .yaml).\n"
      "Examples:\n"
      "  astrolabe inspect take.csv\n"
      "  astrolabe inspect drive.mcap --truth-topic /tracker/pose\n"
      "  astrolabe inspect ticks.csv --wheel-columns time_s,left_counts,right_counts --per-interval --json");
  command.callback([options] {
    ImportOptions& choices = options->choices;
    choices.wheels = choices.truth = {options->file};
    refuse_unused_choices(choices);
    const experiment::FileInspection found =
        experiment::inspect_file(options->file, choices.table, {choices.truth_topic, "", ""});
    if (!found.wheels && (choices.table.per_interval || !choices.table.columns.empty()))
      throw console::WrongUsage(
          "--wheel-columns and --per-interval do not apply here: this is no table of wheels");
    if (options->json) {
      print_json(to_json(found));
    } else {
      write(inspection_text(found));
    }
  });
}

}  // namespace astro::commands
