#include <memory>

#include "host/commands/base/flags.hpp"
#include "host/commands/tune/commands.hpp"
#include "host/commands/tune/wiring_dialogue.hpp"
#include "host/console/options.hpp"

namespace astro::commands {
namespace {

void add_answers(console::Command command, WiringOptions& options) {
  for (const auto& [option, into, motor] : {std::tuple{"--saw-left", &options.saw[0], "left"},
                                            std::tuple{"--saw-right", &options.saw[1], "right"}})
    command
        .add_option(option, *into,
                    std::string("what turned when the ") + motor + " motor was driven: " + sighting_words())
        .type_name("WORD")
        .check(a_sighting());
  command.add_flag("--no-look", options.no_look, "nobody looks: judge by the counts alone");
  const console::Option metres = command
                                     .add_option("--rolled-distance", options.rolled_distance_m,
                                                 "answer to --roll, in m; waits for the robot to be rolled")
                                     .type_name("M")
                                     .check(console::positive("m"));
  command.add_option("--rolled-turns", options.rolled_turns, "the same in wheel turns")
      .type_name("N")
      .check(console::positive(""))
      .excludes(metres);
}

}  // namespace

void add_check_wiring(console::Command app) {
  const auto options = std::make_shared<WiringOptions>();
  const console::Command command = app.add_subcommand(
      "check-wiring", "turn each wheel a little and find wrong wires, polarities and encoder counts");
  add_connection(command, options->connection);
  command.add_option("--max-voltage", options->max_voltage_V, "most that is put on a motor, in V")
      .type_name("V")
      .capture_default_str()
      .check(console::between(0.5, 24, "V"));
  command.add_flag(
      "--roll", options->roll,
      "afterwards: roll the robot ten wheel turns along a tape measure, for counts per revolution");
  add_answers(command, *options);
  command.add_flag("--upload", options->upload, "load corrected parameters without asking");
  command.add_flag("--yes,-y", options->yes, "the wheels are off the ground: do not ask");
  add_json_flag(command, options->json);
  console::examples(
      command, {"astrolabe check-wiring", "astrolabe check-wiring --roll",
                "astrolabe check-wiring --yes --saw-left left-forward --saw-right right-backward --upload"});
  command.callback([options] { check_wiring(*options); });
}

}  // namespace astro::commands
