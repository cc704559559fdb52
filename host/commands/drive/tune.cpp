#include <fmt/format.h>
#include <unistd.h>

#include <charconv>
#include <filesystem>
#include <memory>
#include <numbers>
#include <optional>
#include <string>

#include "host/base/error.hpp"
#include "host/base/text/columns.hpp"
#include "host/commands/base/advice.hpp"
#include "host/commands/base/flags.hpp"
#include "host/commands/drive/commands.hpp"
#include "host/commands/drive/tune_view.hpp"
#include "host/commands/shared/connection.hpp"
#include "host/console/console.hpp"
#include "host/console/options.hpp"
#include "host/console/wrong_usage.hpp"
#include "host/experiment/drive/change_guard.hpp"
#include "host/motor/bench/identify.hpp"
#include "host/motor/bench/tune_motors.hpp"
#include "host/report/page.hpp"

namespace astro::commands {
namespace {

struct TuneOptions {
  ConnectionOptions connection;
  motor::TuningTask task;
  bool on_ground = false;
  std::string bandwidth;  // "6", "6Hz", "40rad/s"; empty: chosen
  bool upload = false, yes = false, json = false;
  std::filesystem::path out = "tune.html";
};

double radps_in(const std::string& bandwidth) {
  if (bandwidth.empty()) return 0;
  const double number = std::stod(bandwidth);
  return bandwidth.ends_with("rad/s") ? number : 2 * std::numbers::pi * number;
}

console::Check a_bandwidth() {
  return [](std::string& text) -> std::string {
    double value = 0;
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
    const std::string unit(end, static_cast<const char*>(text.data() + text.size()));
    const bool known = unit.empty() || unit == "Hz" || unit == "rad/s";
    if (problem == std::errc() && known && value > 0 && value <= 10'000) return {};
    return fmt::format("'{}' is not a bandwidth: write 6, 6Hz or 40rad/s", text);
  };
}

void add_options(console::Command command, TuneOptions& options) {
  add_connection(command, options.connection);
  const console::Option stand = command.add_flag("--on-stand", options.task.on_stand, "the wheels hang free");
  const console::Option ground =
      command.add_flag("--on-ground", options.on_ground, "the robot drives to and fro");
  stand.excludes(ground);
  command
      .add_option("--bandwidth", options.bandwidth,
                  "of the speed loop, as 6, 6Hz or 40rad/s; default: the stiffest against loads")
      .type_name("HZ")
      .check(a_bandwidth());
  add_ranged(command, "--max-voltage", options.task.voltage_V, "most that is put on a motor, in V", "V", 1,
             50, "V");
  add_ranged(command, "--max-distance", options.task.distance_m,
             "on the ground: how far from its start, in m", "M", 0.2, 50, "m")
      .excludes(stand);
  command.add_flag("--upload", options.upload, "load the new values without asking, and measure again");
  add_yes(command, options.yes, "do not ask before the wheels turn; loads nothing without --upload");
  add_json_flag(command, options.json);
  command.add_option("--out", options.out, "the report to write").type_name("FILE").capture_default_str();
}

void find_out_where(TuneOptions& options) {
  if (options.task.on_stand || options.on_ground) return;
  if (options.yes || isatty(STDIN_FILENO) != 1)
    throw console::WrongUsage(
        "say where the robot is: --on-stand (wheels hang free) or --on-ground (it drives by itself)");
  const std::string answer =
      console::ask("Do the wheels hang free, or is the robot on the ground? [free/ground] ");
  options.task.on_stand = answer == "free" || answer == "f";
  options.on_ground = answer == "ground" || answer == "g";
  if (!options.task.on_stand && !options.on_ground)
    throw Error("nothing was measured: answer 'free' or 'ground'");
}

void agree(const TuneOptions& options) {
  if (options.yes) return;
  const double seconds = options.task.duration_s();
  const std::string question =
      options.task.on_stand
          ? fmt::format("Both wheels will turn for about {:.0f} s, with up to {:g} V. Begin?", seconds,
                        options.task.voltage_V)
          : fmt::format(
                "The robot will drive to and fro by itself for about {:.0f} s, up to {:g} m from here "
                "and with up to {:g} V. Is the floor free?",
                seconds, options.task.distance_m, options.task.voltage_V);
  if (!console::confirm(question)) throw Error("nothing was measured");
}

// Checked before anything turns, because a measurement that cannot be saved is lost.
void check_out(const std::filesystem::path& out) {
  const auto folder = std::filesystem::absolute(out).parent_path();
  if (out.empty() || !std::filesystem::is_directory(folder) || std::filesystem::is_directory(out))
    throw Error(fmt::format(
        "--out: the report cannot be written to '{}': name a file in a folder that exists", out.string()));
  report::require_replaceable(out);
}

/// A bar while the motors are identified.
motor::TuningHooks hooks_with(std::optional<console::Progress>& bar) {
  motor::TuningHooks hooks;
  hooks.drive = drive_hooks();
  hooks.drive.notice = [&bar](const Remark& remark) {
    if (bar) bar->clear();
    console::say(in_words(remark));
  };
  hooks.progress = [&bar](double part) {
    if (!bar) bar.emplace("measuring");
    bar->show(part);
  };
  hooks.identified = [&bar](const motor::IdentifiedMotors&) { bar.reset(); };
  hooks.uploaded = [](const Remark& remark) { console::say(in_words(remark)); };
  return hooks;
}

bool wants_upload(const TuneOptions& options, const motor::TuningResult& result) {
  if (result.changes.empty()) {
    console::say("the robot holds these values already");
    return false;
  }
  console::say(console::table(experiment::side_by_side(result.changes), "llrrr"));
  if (options.upload) return true;
  return !options.yes && isatty(STDIN_FILENO) == 1 && console::confirm("Load these into the robot?");
}

void write_report(const TuneOptions& options, const motor::TuningResult& result,
                  const robot::Client& client) {
  report::write_page(options.out, report::render_tuning_html(report_input(result, client)));
}

void conclude(const TuneOptions& options, const motor::TuningResult& result) {
  const std::string path = std::filesystem::absolute(options.out).string();
  if (!options.json)
    return print(fmt::format("{}\n{}{}\nReport: {}", step_after_in_words(result), wrapped(verdict(result)),
                             result.uploaded ? "The new values are loaded." : "Nothing was loaded.", path));
  Json json = to_json(result);
  json["report"] = path;
  print_json(json);
}

void run(TuneOptions& options) {
  find_out_where(options);
  check_out(options.out);
  const auto client = connect_to_drive(options.connection);
  agree(options);
  std::optional<console::Progress> bar;
  const motor::TuningHooks hooks = hooks_with(bar);
  options.task.bandwidth_radps = radps_in(options.bandwidth);
  motor::TuningResult result = tune_motors(*client, options.task, hooks);
  write_report(options, result, *client);  // saved before the upload, which may fail
  if (!options.json) print(in_words(result));
  if (wants_upload(options, result)) {
    load_and_measure_again(*client, result, hooks);
    write_report(options, result, *client);
  }
  conclude(options, result);
}

constexpr Advice kTuneAdvice[] = {
    {motor::BenchProblem::out_of_room, "; give it more room with --max-distance"},
    {motor::BenchProblem::stands_at_little_voltage,
     "; 'astrolabe check-wiring' finds out which, or give it more with --max-voltage"},
};

}  // namespace

void add_tune(console::Command app) {
  advise(kTuneAdvice);
  const auto options = std::make_shared<TuneOptions>();
  const console::Command command =
      app.add_subcommand("tune", "measure the motors, compute feed-forward and gains, show and load them");
  add_options(command, *options);
  console::examples(
      command, {"astrolabe tune --on-ground --max-distance 1.5", "astrolabe tune --on-stand --bandwidth 6",
                "astrolabe tune --on-ground --yes --upload --json --out tune.html"});
  command.callback([options] { run(*options); });
}

}  // namespace astro::commands
