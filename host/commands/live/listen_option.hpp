#pragma once

#include <cstdint>
#include <string>

#include "host/console/command_line.hpp"
#include "host/live/web/server.hpp"

namespace astro::commands {

/// Where a server of this program can be reached: --listen of every command that serves viewers or pages.
struct ListenOption {
  std::string listen;         // see listen_address_in
  console::Option listening;  // that option
};

/// `help`: who connects there.
void add_listen(console::Command command, ListenOption& option, const std::string& help);

/// If `port` is a bare number, it is that of --listen, as with other such servers, because no robot's port is a bare number.
/// Moves it from `port` to `option`. Throws WrongUsage if it is no valid port, or if --listen is given, too.
void take_listen_port(std::string& port, ListenOption& option);

/// "8765", "localhost:8765", "0.0.0.0:8765" or "[::1]:8765". Throws astro::Error that names the word otherwise.
web::Address listen_address_in(const std::string& word);

bool is_loopback(const std::string& ip);

/// The host and the port of a URL.
std::string place_in_url(const std::string& ip, std::uint16_t port);

}  // namespace astro::commands
