#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>

#include "host/link/descriptor.hpp"
#include "host/link/relay_session.hpp"
#include "host/link/transport.hpp"

/// The socket by which the programs of one user find the one that holds a port: a file in runtime_folder(),
/// which only this user can enter, named by the port's key.
namespace astro::link {

std::filesystem::path socket_of(const std::string& port_key);

/// Listens there, in place of a socket that a dead program has left behind, and takes away those of other
/// ports. To be called by who holds the port's lock. Throws Error.
Descriptor listen_at(const std::filesystem::path& socket);

/// Takes the file away. To be called by who holds the port's lock.
void remove_socket(const std::filesystem::path& socket);

/// The program at the other end of a connection, or the one that listens there; nothing if it belongs to
/// another user.
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
Served connect_to(const std::filesystem::path& socket, microseconds patience);

/// The sentence for Served::busy.
std::string does_not_answer(const PortUser& holder);

}  // namespace astro::link
