#pragma once

#include <sys/types.h>

#include <optional>
#include <string>

#include "host/robot/port/descriptor.hpp"
#include "host/robot/sharing/relay_session.hpp"
#include "host/robot/port/transport.hpp"

/// The socket by which programs find the one that holds a port: an abstract one of Linux, named by the port's
/// key. It ends with the program that listens, and it is found whatever the environment says: an emergency
/// stop may come from another terminal, from cron or from ssh. Everybody can connect to it, so each side looks
/// at the other's user before it says a word.
///
/// Rejected: a file in the folder that XDG_RUNTIME_DIR names. Two terminals need not agree about that, and
/// files outlive those who made them.
namespace astro::robot {

/// Throws Error if the name is taken, by a program of another user or by one that has not ended yet.
Descriptor listen_at(const std::string& port_key);

/// The program at the other end of a connection, or the one that listens there; nothing if it belongs to
/// another user, who is not root.
std::optional<PortUser> peer_of(const Descriptor& connection);

/// The process and its command line, of which only the printable part is kept.
PortUser describe_process(pid_t pid);

/// "process id 12, 'astrolabe drive line 2'".
std::string in_words(std::uint32_t pid, std::string_view command);

/// One try to be served by who holds a port.
struct Served {
  Descriptor connection;         // greeted; else:
  std::optional<PortUser> busy;  // who listens there but has not greeted us in time
};

/// Waits up to `patience` for the greeting. Neither: nobody of ours listens there.
Served connect_to(const std::string& port_key, microseconds patience);

/// The sentence for Served::busy.
std::string does_not_answer(const PortUser& holder);

}  // namespace astro::robot
