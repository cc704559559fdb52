#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace astro::robot {

/// A port at which a robot may be.
struct Port {
  std::string address;  // for open_transport; a name that stays the same after re-plugging, if there is one
  std::string device;   // what it leads to: /dev/ttyACM0, /dev/pts/3
  bool simulator = false;  // a link in runtime_folder()
};

/// The folder where simulators of this user put NAME.pty, a symlink to their pty: $XDG_RUNTIME_DIR/astrolabe-
/// UID, or below /tmp if that variable is not set. May not exist.
std::filesystem::path runtime_folder();

/// runtime_folder(), created if needed, for this user alone. Throws Error if it cannot be created or belongs
/// to somebody else.
std::filesystem::path make_runtime_folder();

/// /dev/serial/by-id/*, /dev/ttyACM*, /dev/ttyUSB*, each device once, then simulators; sorted. Links that
/// lead nowhere are left out, and so is a runtime folder that somebody else owns. Opens nothing.
std::vector<Port> candidate_ports(const std::filesystem::path& devices = "/dev",
                                  const std::filesystem::path& simulators = runtime_folder());

/// Name of a process whose controlling terminal this device is. A pty's number is reused when its simulator
/// has ended: without this check the link of a dead simulator can lead into somebody's shell.
std::optional<std::string> terminal_user(dev_t device);

}  // namespace astro::robot
