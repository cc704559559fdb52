#pragma once

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstddef>
#include <cstring>
#include <stdexcept>
#include <string>

namespace astro::support {

/// Takes a name that one process of this computer can have at a time; the system gives it back when the process ends.
inline bool claim(const std::string& name) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::memcpy(address.sun_path + 1, name.data(), name.size());  // after a NUL: a name that is no file
  const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + name.size());
  const int fd = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  if (bind(fd, reinterpret_cast<const sockaddr*>(&address), size) == 0) return true;
  close(fd);
  return false;
}

/// Of DDS: this process's own, and the next one besides. Programs that run side by side do not meet. Domains above 101 would
/// use ports that Linux gives to others.
inline int test_domain() {
  static const int domain = [] {
    for (int each = 1; each < 100; each += 2)
      if (claim("astro-test-domain-" + std::to_string(each))) return each;
    throw std::runtime_error("fifty programs test DDS at once");
  }();
  return domain;
}

}  // namespace astro::support
