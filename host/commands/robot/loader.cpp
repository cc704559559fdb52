#include "host/commands/robot/loader.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>

#include "host/base/child_process.hpp"
#include "host/base/error.hpp"
#include "host/base/system_error.hpp"
#include "host/console/console.hpp"
#include "host/console/interrupt.hpp"
#include "host/robot/motion/drive.hpp"

namespace astro::commands {
namespace {

namespace fs = std::filesystem;

constexpr auto kUntilItSeemsLong = std::chrono::seconds(15), kUntilItIsTooLong = std::chrono::seconds(120);

bool runnable(const fs::path& path) {
  std::error_code unreadable;
  return fs::is_regular_file(path, unreadable) && access(path.c_str(), X_OK) == 0;
}

constexpr const char* kInterrupted =
    "interrupted: the robot waits in its boot loader for 'astrolabe flash --button'";

void start_loader(ChildProcess& child, const fs::path& loader, const fs::path& hex, ChildProcess::Line line) {
  const int failure = child.start({fs::absolute(loader).string(), "--mcu=TEENSY40", "-w", "-v", hex.string()},
                                  ChildProcess::Output::lines, std::move(line));
  if (failure == 0) return;
  const std::string fact = fmt::format("'{}' cannot be run", loader.string());
  if (failure == ENOEXEC || failure == EACCES) throw Error(fact + ": is it a program?");
  throw system_error(fact, failure);
}

void wait_for_loader(ChildProcess& child) {
  const auto begun = std::chrono::steady_clock::now();
  bool warned = false;
  while (child.writes_lines()) {
    const auto taken = std::chrono::steady_clock::now() - begun;
    if (!warned && taken > kUntilItSeemsLong) {
      console::say("the loader waits for a Teensy: is its USB cable plugged in? (Ctrl-C ends it)");
      warned = true;
    }
    if (taken > kUntilItIsTooLong)
      throw Error("the loader found no Teensy: plug in its USB cable, and flash again with --button");
    if (console::interrupted()) throw Interrupted(kInterrupted);
    child.wait(std::chrono::milliseconds(50));
  }
}

}  // namespace

std::optional<fs::path> program_on_path(const std::string& name) {
  const char* folders = std::getenv("PATH");
  std::istringstream path(folders != nullptr ? folders : "");
  for (std::string folder; std::getline(path, folder, ':');)
    if (runnable(fs::path(folder) / name)) return fs::path(folder) / name;
  return std::nullopt;
}

fs::path find_loader() {
  if (const char* named = std::getenv("ASTROLABE_LOADER"); named != nullptr) {
    if (runnable(named)) return named;
    throw Error(fmt::format("ASTROLABE_LOADER names '{}', which is no program: unset it or name one", named));
  }
  if (const auto loader = program_on_path("teensy_loader_cli")) return *loader;
  throw Error("teensy_loader_cli is not installed: apt install teensy-loader-cli");
}

void run_loader(const fs::path& loader, const fs::path& hex) {
  std::string last = "it said nothing";
  ChildProcess child;
  start_loader(child, loader, hex, [&](std::string_view line) {
    if (line.find_first_not_of(" \t") != line.npos) last = line;
  });
  wait_for_loader(child);
  const auto status = child.finish(kUntilItIsTooLong);
  // Ctrl-C at the terminal reaches the loader, too.
  if (!status && console::interrupted()) throw Interrupted(kInterrupted);
  if (status != 0)
    throw Error(
        fmt::format("the loader failed: {} (press the robot's button and flash again with --button)", last));
}

}  // namespace astro::commands
