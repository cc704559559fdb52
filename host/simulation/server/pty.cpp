#include "host/simulation/server/pty.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "host/base/system_error.hpp"

namespace astro::simulation {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& what) {
  throw system_error("no pseudo terminal can be opened: " + what, errno);
}

Descriptor open_master() {
  Descriptor master(posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC | O_NONBLOCK));
  if (!master) fail("posix_openpt");
  if (grantpt(master.get()) != 0 || unlockpt(master.get()) != 0) fail("unlockpt");
  return master;
}

std::string device_of(int fd) {
  std::array<char, 128> name{};
  if (ptsname_r(fd, name.data(), name.size()) != 0) fail("ptsname");
  return name.data();
}

// The settings belong to the terminal, not to the descriptor, so they stay when the descriptor is closed.
void make_raw(const std::string& device) {
  const Descriptor hosts_end(open(device.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC));
  if (!hosts_end) fail(device);
  termios settings{};
  if (tcgetattr(hosts_end.get(), &settings) != 0) fail("tcgetattr");
  cfmakeraw(&settings);
  if (tcsetattr(hosts_end.get(), TCSANOW, &settings) != 0) fail("tcsetattr");
}

// Refers to the terminal without opening it, so that the terminal still shows whether a host has it open.
Descriptor refer_to(const std::string& device) {
  Descriptor reference(open(device.c_str(), O_PATH | O_CLOEXEC));
  if (!reference) fail(device);
  return reference;
}

PathClaim claim(const fs::path& link) {
  if (auto claim = PathClaim::of(link)) return std::move(*claim);
  throw Error("'" + link.string() + "' is in use by another simulator", ServerProblem::path_in_use,
              {link.string()});
}

/// Whether the path is the link of a simulator, running or ended. The simulator has ended if nobody has
/// claimed the link, or if the link leads nowhere.
bool left_behind(const fs::path& link) {
  std::error_code error;
  const fs::path target = fs::read_symlink(link, error);
  if (error) return false;
  const bool by_descriptor = target.string().starts_with("/proc/") && target.parent_path().filename() == "fd";
  return by_descriptor || target.parent_path() == "/dev/pts";  // the latter by earlier versions
}

/// Whether the simulator of a link in the runtime folder has ended. The link leads to a terminal, or to a
/// simulator's link elsewhere. The test takes the claim for a moment, so a simulator that starts at that
/// moment is refused the path, and the link stays.
bool is_dead(const fs::path& link) {
  std::error_code error;
  const fs::path target = fs::read_symlink(link, error);
  if (error) return false;
  const fs::path claimed = left_behind(link) ? link : target;
  if (!fs::exists(fs::symlink_status(claimed, error))) return true;
  if (!left_behind(claimed)) return false;  // not the link of a simulator
  return PathClaim::of(claimed).has_value();
}

void make_link(const fs::path& target, const fs::path& link) {
  std::error_code error;
  if (left_behind(link)) {
    fs::remove(link);
  } else if (fs::exists(fs::symlink_status(link))) {
    throw Error("'" + link.string() + "' exists and is not a simulator's", ServerProblem::path_taken,
                {link.string()});
  }
  fs::create_symlink(target, link, error);
  if (error)
    throw Error("'" + link.string() + "' cannot be made (" + error.message() + ")",
                ServerProblem::path_refused, {link.string()});
}

}  // namespace

Pty::Pty(const fs::path& link) : master_(open_master()) {
  const std::string device = device_of(master_.get());
  make_raw(device);
  reference_ = refer_to(device);
  target_ = fmt::format("/proc/{}/fd/{}", getpid(), reference_.get());
  add_link(link);
}

Pty::~Pty() {
  std::error_code ignored;
  for (const fs::path& link : links_)
    if (fs::is_symlink(link) && fs::read_symlink(link, ignored) == target_) fs::remove(link, ignored);
}

void Pty::add_link(const fs::path& link) {
  claims_.push_back(claim(link));
  make_link(target_, link);
  links_.push_back(link);
}

bool Pty::connected() const {
  pollfd state{master_.get(), POLLOUT, 0};
  return poll(&state, 1, 0) >= 0 && (state.revents & POLLHUP) == 0;
}

std::uint32_t Pty::baud() const {
  termios settings{};
  return tcgetattr(master_.get(), &settings) == 0 && cfgetospeed(&settings) == B134 ? 134 : 115'200;
}

std::size_t Pty::read(std::span<std::uint8_t> into) {
  const ssize_t count = ::read(master_.get(), into.data(), into.size());
  return count > 0 ? static_cast<std::size_t>(count) : 0;  // EAGAIN, or EIO while no program has it open
}

std::size_t Pty::write(std::span<const std::uint8_t> bytes) {
  const ssize_t count = ::write(master_.get(), bytes.data(), bytes.size());
  return count > 0 ? static_cast<std::size_t>(count) : 0;
}

void sweep_dead_links(const fs::path& folder) {
  std::error_code error;
  if (!fs::is_directory(fs::symlink_status(folder, error)))
    return;  // a link could lead to another user's folder
  std::vector<fs::path> dead;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error))
    if (entry.path().extension() == ".pty" && entry.is_symlink(error) && is_dead(entry.path()))
      dead.push_back(entry.path());
  for (fs::path link : dead) {
    fs::remove(link, error);
    link += ".mocap";
    if (fs::is_socket(fs::symlink_status(link, error)) || fs::is_symlink(link, error))
      fs::remove(link, error);
  }
}

RuntimeLink::RuntimeLink(const fs::path& folder, const fs::path& pty) : target_(fs::absolute(pty)) {
  std::error_code error;
  if (fs::equivalent(target_.parent_path(), folder, error) && pty.extension() == ".pty") return;
  constexpr int kNames = 100;
  for (int i = 1; i <= kNames; ++i) {
    const std::string number = i == 1 ? "" : "-" + std::to_string(i);
    const fs::path link = folder / (pty.stem().string() + number + ".pty");
    if (fs::is_symlink(link, error) && !fs::exists(link, error)) fs::remove(link, error);  // dead link
    fs::create_symlink(target_, link, error);
    if (error == std::errc::file_exists) continue;
    if (!error) link_ = link;
    return;
  }
}

RuntimeLink::~RuntimeLink() {
  std::error_code error;
  if (!link_.empty() && fs::read_symlink(link_, error) == target_) fs::remove(link_, error);
}

}  // namespace astro::simulation
