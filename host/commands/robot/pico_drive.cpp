#include "host/commands/robot/pico_drive.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <optional>
#include <sstream>
#include <string>
#include <thread>

#include "host/base/descriptor.hpp"
#include "host/base/error.hpp"
#include "host/base/files.hpp"
#include "host/base/interrupted.hpp"
#include "host/base/system_error.hpp"
#include "host/console/console.hpp"
#include "host/console/interrupt.hpp"

namespace astro::commands {
namespace {

namespace fs = std::filesystem;

constexpr auto kDriveSeemsLate = std::chrono::seconds(10), kDriveIsTooLate = std::chrono::seconds(120);

/// What the system says of itself has no size, so it is read to its end. Empty if it cannot be read.
std::string contents(const fs::path& path) {
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  std::string text;
  std::array<char, 4096> part{};
  constexpr std::size_t kMost = std::size_t{1} << 20;
  for (ssize_t count = 1; file && count > 0 && text.size() < kMost;) {
    count = ::read(file.get(), part.data(), part.size());
    if (count > 0) text.append(part.data(), static_cast<std::size_t>(count));
  }
  return text;
}

/// The boot loader describes itself in a file of its drive.
bool is_pico_drive(const fs::path& folder) {
  return contents(folder / "INFO_UF2.TXT").find("RPI-RP2") != std::string::npos;
}

/// A field of /proc/mounts, where blanks are written as \040.
std::string unescaped(const std::string& field) {
  std::string text;
  for (std::size_t i = 0; i < field.size(); ++i)
    if (field[i] == '\\' && i + 3 < field.size()) {
      text.push_back(static_cast<char>(std::strtoul(field.substr(i + 1, 3).c_str(), nullptr, 8)));
      i += 3;
    } else {
      text.push_back(field[i]);
    }
  return text;
}

std::optional<fs::path> find_drive() {
  if (const char* named = std::getenv("ASTROLABE_PICO_DRIVE"); named != nullptr)
    return is_pico_drive(named) ? std::optional<fs::path>(named) : std::nullopt;
  return pico_drive_among(contents("/proc/self/mounts"));
}

fs::path wait_for_drive() {
  const auto begun = std::chrono::steady_clock::now();
  bool warned = false;
  while (true) {
    if (const auto drive = find_drive()) return *drive;
    const auto taken = std::chrono::steady_clock::now() - begun;
    if (!warned && taken > kDriveSeemsLate) {
      console::say(
          "still no drive RPI-RP2: is its USB cable plugged in, and does this computer mount drives by "
          "itself? If not: mount "
          "it (Ctrl-C ends this)");
      warned = true;
    }
    if (taken > kDriveIsTooLate)
      throw Error(
          "no drive RPI-RP2 appeared: hold BOOTSEL while you plug in the Pico, and flash again with "
          "--button");
    if (console::interrupted())
      throw Interrupted("interrupted: the robot waits in its boot loader for 'astrolabe flash --button'");
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
}

/// The chip restarts as soon as it has the last block, perhaps before the system has closed the file: so only a failure to
/// write counts.
void copy(const Bytes& bytes, const fs::path& to) {
  const Descriptor file(::open(to.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644));
  if (!file) throw system_error(fmt::format("cannot write '{}'", to.string()), errno);
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t count = ::write(file.get(), bytes.data() + done, bytes.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) throw system_error(fmt::format("cannot write '{}'", to.string()), errno);
    done += static_cast<std::size_t>(count);
  }
  ::fsync(file.get());
}

}  // namespace

std::optional<fs::path> pico_drive_among(const std::string& mounts) {
  std::istringstream lines(mounts);
  std::string device_found;
  std::optional<fs::path> found;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream fields(line);
    std::string device, folder, type;
    fields >> device >> folder >> type;
    std::error_code missing;
    // The files of a device that was unplugged may still be read, from memory.
    if (type != "vfat" || !fs::exists(unescaped(device), missing) || !is_pico_drive(unescaped(folder)))
      continue;
    if (found && device != device_found)
      throw Error(
          fmt::format("'{}' and '{}' are both drives RPI-RP2: unplug the Pico that is not to be flashed",
                      found->string(), unescaped(folder)));
    device_found = device;
    found = unescaped(folder);
  }
  return found;
}

void copy_to_pico(const fs::path& uf2) {
  const Bytes bytes = load_file(uf2);
  const fs::path drive = wait_for_drive();
  console::say(fmt::format("copying to {}", drive.string()));
  copy(bytes, drive / "astrolabe.uf2");
}

}  // namespace astro::commands
