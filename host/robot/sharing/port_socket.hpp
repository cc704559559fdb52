#pragma once

#include <sys/types.h>

#include <optional>
#include <string>

#include "host/base/descriptor.hpp"
#include "host/base/error.hpp"
#include "host/robot/port/transport.hpp"
#include "host/robot/sharing/port_user.hpp"

/// The socket at which programs find the program that holds a port (the holder): a Linux abstract socket,
/// named by the port's key. It ends with the program that listens, and it does not depend on environment
/// variables, because an emergency stop may come from another terminal, from cron or from ssh. Everybody can
/// connect to it, so each side checks the other's user before it sends anything.
///
/// Rejected: a file in the folder that XDG_RUNTIME_DIR names. Two terminals may have different values there,
/// and files outlive the programs that made them.
namespace astro::robot {

/// What is wrong with the program that holds a port. `not_shared`: other programs cannot connect to this one;
/// value: the port's address. Value of the others: the holder's process id, if it is known.
enum class SharingProblem { not_shared, holder_hangs, holder_ended };

/// Throws Error if the name is in use, by a program of another user or by one that has not ended yet.
Descriptor listen_at(const std::string& port_key);

/// The program at the other end of a connection, or the one that listens there; nothing if it belongs to
/// another user who is not root.
std::optional<PortUser> peer_of(const Descriptor& connection);

/// The process and the printable part of its command line.
PortUser describe_process(pid_t pid);

/// The result of one try to be served by the program that holds a port.
struct HolderConnection {
  Descriptor connection;         // after its Welcome; empty if none came
  std::optional<PortUser> busy;  // the program that listens there but has sent no Welcome in time
};

/// Waits up to `timeout` for the holder's Welcome. Both members are empty if no program of this user listens
/// there.
HolderConnection connect_to(const std::string& port_key, microseconds timeout);

/// The message about HolderConnection::busy.
Remark holder_hangs(const PortUser& holder);

}  // namespace astro::robot
