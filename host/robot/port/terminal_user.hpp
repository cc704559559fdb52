#pragma once

#include <sys/types.h>

#include <optional>
#include <string>

namespace astro::robot {

/// Name of a process whose controlling terminal this device is. A pty's number is reused when its simulator
/// has ended: without this check the link of a dead simulator can lead into somebody's shell.
std::optional<std::string> terminal_user(dev_t device);

}  // namespace astro::robot
