#include "host/simulation/server/path_claim.hpp"

#include <fmt/format.h>
#include <sys/socket.h>
#include <sys/un.h>

#include <cerrno>
#include <cstddef>
#include <functional>
#include <string>
#include <utility>

#include "host/base/system_error.hpp"

namespace astro::simulation {

std::optional<PathClaim> PathClaim::of(const std::filesystem::path& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const std::string whole = std::filesystem::absolute(path).lexically_normal();
  const std::string name = fmt::format("astrolabe-pty-{:016x}", std::hash<std::string>{}(whole));
  name.copy(address.sun_path + 1, sizeof(address.sun_path) - 1);  // a leading zero byte makes it abstract
  const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + name.size());
  Descriptor claim(socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
  if (claim && bind(claim.get(), reinterpret_cast<const sockaddr*>(&address), size) == 0)
    return PathClaim(std::move(claim));
  if (errno == EADDRINUSE) return std::nullopt;
  throw system_error(fmt::format("it cannot be known whether '{}' is in use", path.string()), errno);
}

}  // namespace astro::simulation
