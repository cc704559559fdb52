#include "host/robot/port/ports.hpp"

#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "host/base/error.hpp"
#include "host/base/system_error.hpp"

namespace astro::robot {

namespace fs = std::filesystem;

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

std::optional<Process> read_stat(const fs::path& folder) {
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

std::vector<fs::path> entries(const fs::path& folder) {
  std::vector<fs::path> paths;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) paths.push_back(entry.path());
  if (error == std::errc::too_many_files_open || error == std::errc::too_many_files_open_in_system)
    throw system_error("the folder '" + folder.string() + "' cannot be listed", error.value());
  std::sort(paths.begin(), paths.end());
  return paths;
}

bool is_mine(const fs::path& folder) {
  struct stat about {};
  return ::lstat(folder.c_str(), &about) == 0 && S_ISDIR(about.st_mode) && about.st_uid == ::geteuid();
}

bool leads_to_a_terminal(const fs::path& device) {
  struct stat about {};
  return ::stat(device.c_str(), &about) == 0 && S_ISCHR(about.st_mode) && terminal_user(about.st_rdev);
}

void add(std::vector<Port>& ports, const fs::path& path, bool simulator) {
  std::error_code dead;
  const fs::path device = fs::canonical(path, dead);
  if (dead || (simulator && leads_to_a_terminal(device))) return;
  const auto same = [&](const Port& port) { return port.device == device; };
  if (std::none_of(ports.begin(), ports.end(), same)) ports.push_back({path, device, simulator});
}

}  // namespace

fs::path runtime_folder() {
  const char* folder = std::getenv("XDG_RUNTIME_DIR");
  const fs::path base = folder != nullptr && *folder != '\0' ? folder : "/tmp";
  return base / ("astrolabe-" + std::to_string(::getuid()));
}

fs::path make_runtime_folder() {
  constexpr const char* kChooseFolder = "; set XDG_RUNTIME_DIR to a folder that belongs to you";
  const fs::path folder = runtime_folder();
  if (::mkdir(folder.c_str(), 0700) != 0 && errno != EEXIST)
    throw system_error("the folder '" + folder.string() + "' cannot be made", errno, kChooseFolder);
  struct stat about {};
  if (::lstat(folder.c_str(), &about) != 0 || !S_ISDIR(about.st_mode) || about.st_uid != ::geteuid())
    throw Error("'" + folder.string() + "' is not a folder of this user" + kChooseFolder);
  if ((about.st_mode & 077) != 0 && ::chmod(folder.c_str(), 0700) != 0)
    throw Error("'" + folder.string() + "' is open to others and cannot be closed" + kChooseFolder);
  return folder;
}

std::vector<Port> candidate_ports(const fs::path& devices, const fs::path& simulators) {
  std::vector<Port> ports;
  for (const auto& path : entries(devices / "serial" / "by-id")) add(ports, path, false);
  for (const auto& path : entries(devices)) {
    const std::string name = path.filename();
    if (name.starts_with("ttyACM") || name.starts_with("ttyUSB")) add(ports, path, false);
  }
  if (!is_mine(simulators)) return ports;
  for (const auto& path : entries(simulators)) {
    if (path.extension() == ".pty") add(ports, path, true);
  }
  return ports;
}

std::optional<std::string> terminal_user(dev_t device) {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator("/proc", error)) {
    const std::string name = entry.path().filename();
    if (name.find_first_not_of("0123456789") != std::string::npos) continue;
    const auto process = read_stat(entry.path());
    if (process && process->tty == tty_number(device)) return process->name;
  }
  return std::nullopt;
}

}  // namespace astro::robot
