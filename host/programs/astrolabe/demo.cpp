#include "host/programs/astrolabe/demo.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "host/base/error.hpp"
#include "host/commands/selftest/demo_robot.hpp"
#include "host/console/program.hpp"

namespace astro::commands {
namespace {

namespace fs = std::filesystem;

struct DemoOptions {
  fs::path folder = "astrolabe-demo";
  std::uint64_t seed = 1;
};

/// False if the command says no to its question, which is then the answer of the demonstration, too.
bool carry_out(const std::function<int(const std::vector<std::string>&)>& run,
               const std::vector<std::string>& words) {
  const int code = run(words);
  if (code != 0 && code != console::kAnswerIsNo)
    throw Error("the demonstration ends here, because 'astrolabe " + words.front() + "' was refused");
  return code == 0;
}

void demonstrate(const DemoOptions& options, const std::function<int(const std::vector<std::string>&)>& run) {
  const fs::path folder = fs::absolute(options.folder);  // not to be taken for an option
  if (fs::exists(folder))
    throw Error("'" + folder.string() + "' exists already: remove it, or name another folder with --out");
  fs::create_directories(folder);
  const fs::path port = folder / "robot.pty", experiment = folder / "experiment";
  const DemoRobot robot(port, {"--fast", "--seed", std::to_string(options.seed)});
  if (!carry_out(run, {"umbmark", "--port", port.string(), "--truth", "sim", "--runs", "5", "--side", "3",
                       "--out", experiment.string(), "--yes"}))
    return;
  fmt::print("\nHow the factors were found, from the drives before:\n");
  if (!carry_out(run, {"calibrate", "runs", (experiment / "before").string()})) return;
  fmt::print("\nThe report with both: {}\n", (experiment / "report.html").string());
  fmt::print("The same in a browser, with a robot to drive: astrolabe dashboard\n");
}

}  // namespace

void add_demo(console::Command app, const std::function<int(const std::vector<std::string>&)>& run) {
  const auto options = std::make_shared<DemoOptions>();
  const console::Command command = app.add_subcommand(
      "demo", "calibrate a simulated robot from end to end, with a report: nothing else is needed");
  command.add_option("--out", options->folder, "folder for drives and report").capture_default_str();
  command.add_option("--seed", options->seed, "of the noise: other seeds, other drives")
      .capture_default_str();
  command.footer("Examples:\n  astrolabe demo --out /tmp/my-demo");
  command.callback([options, run] { demonstrate(*options, run); });
}

}  // namespace astro::commands
