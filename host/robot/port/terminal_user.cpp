#include "host/robot/port/terminal_user.hpp"

#include <sys/sysmacros.h>

#include <charconv>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace astro::robot {

namespace {

/// As the kernel writes a device in /proc/PID/stat: proc(5), field 7, tty_nr.
long tty_number(dev_t device) {
  const unsigned low = minor(device);
  return static_cast<long>((low & 0xFFU) | (major(device) << 8) | ((low & ~0xFFU) << 12));
}

struct Process {
  std::string name;
  long tty = 0;
};

std::optional<Process> read_stat(const std::filesystem::path& folder) {
  std::ifstream file(folder / "stat");
  std::stringstream text;
  text << file.rdbuf();
  const std::string all = text.str();
  const auto open = all.find('(');
  const auto close = all.rfind(')');  // a name may hold brackets and blanks
  if (open == std::string::npos || close == std::string::npos) return std::nullopt;
  std::istringstream rest(all.substr(close + 1));
  std::string state;
  long parent = 0, group = 0, session = 0;
  Process process{all.substr(open + 1, close - open - 1), 0};
  if (!(rest >> state >> parent >> group >> session >> process.tty)) return std::nullopt;
  return process;
}

}  // namespace

std::optional<std::string> terminal_user(dev_t device) {
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator("/proc", error)) {
    const std::string name = entry.path().filename();
    if (name.find_first_not_of("0123456789") != std::string::npos) continue;
    const auto process = read_stat(entry.path());
    if (process && process->tty == tty_number(device)) return process->name;
  }
  return std::nullopt;
}

}  // namespace astro::robot
