#include "host/commands/selftest/machine.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <initializer_list>

#include "host/base/error.hpp"
#include "host/commands/robot/image_search.hpp"
#include "host/commands/robot/loader.hpp"
#include "host/robot/port/ports.hpp"

namespace astro::commands {
namespace {

namespace fs = std::filesystem;
using Kind = Finding::Kind;

Finding program(const char* what, std::initializer_list<const char*> names, const char* without) {
  for (const char* name : names)
    if (const auto path = program_on_path(name)) return {Kind::works, what, path->string()};
  return {Kind::missing, what, without};
}

/// Those of real boards; simulators belong to whoever runs them.
std::vector<Finding> serial_ports() {
  std::vector<Finding> found;
  for (const robot::Port& port : robot::candidate_ports()) {
    if (port.simulator) continue;
    if (access(port.device.c_str(), R_OK | W_OK) == 0)
      found.push_back({Kind::works, "serial port", port.device + " can be used"});
    else
      found.push_back({Kind::fails, "serial port",
                       port.device +
                           " is there, and you may not use it: 'sudo usermod -aG dialout $USER', then "
                           "log in again"});
  }
  return found;
}

Finding udev_rules() {
  for (const char* folder :
       {"/etc/udev/rules.d", "/usr/lib/udev/rules.d", "/lib/udev/rules.d", "/usr/local/lib/udev/rules.d"})
    if (const fs::path rules = fs::path(folder) / "60-astrolabe.rules"; fs::exists(rules))
      return {Kind::works, "udev rules", rules.string()};
  return {Kind::missing, "udev rules",
          "for Teensy and Pico without root: the package brings them, or copy "
          "cmake/package/60-astrolabe.rules to "
          "/etc/udev/rules.d"};
}

Finding firmware(const char* board) {
  const std::string what = fmt::format("firmware {}", board);
  try {
    return {Kind::works, what, find_image(board).string()};
  } catch (const Error&) {
    return {
        Kind::missing, what,
        fmt::format("for 'astrolabe flash': the package brings it, or './dev firmware {}' builds it", board)};
  }
}

}  // namespace

std::vector<Finding> look_at_machine() {
  std::vector<Finding> found = serial_ports();
  if (found.empty())
    found.push_back({Kind::missing, "serial port", "no board is plugged in; a simulated robot needs none"});
  found.push_back(udev_rules());
  for (const char* board : {"teensy40", "rp2040"}) found.push_back(firmware(board));
  found.push_back(program("teensy loader", {"teensy_loader_cli"},
                          "for 'astrolabe flash' of a Teensy: apt install teensy-loader-cli"));
  found.push_back(program("ffmpeg", {"ffmpeg"}, "for phone films as ground truth: apt install ffmpeg"));
  found.push_back(program("web browser", {"xdg-open", "firefox", "firefox-esr", "chromium", "google-chrome"},
                          "for reports, which any browser shows: apt install chromium"));
  return found;
}

}  // namespace astro::commands
