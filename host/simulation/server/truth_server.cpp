#include "host/simulation/server/truth_server.hpp"

#include <fmt/format.h>
#include <sys/socket.h>
#include <sys/un.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "host/base/system_error.hpp"
#include "host/simulation/server/pty.hpp"

namespace astro::simulation {
namespace {

constexpr std::size_t kMostWaiting = 4U << 20U;

Descriptor listen_at(const std::filesystem::path& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const std::string text = path.string();
  if (text.size() >= sizeof(address.sun_path))
    throw Error("the path '" + text + "' is too long for a socket", ServerProblem::path_too_long, {text});
  std::strcpy(address.sun_path, text.c_str());
  std::error_code ignored;
  if (std::filesystem::is_socket(path, ignored)) std::filesystem::remove(path, ignored);
  Descriptor listener(socket(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  if (!listener || bind(listener.get(), reinterpret_cast<const sockaddr*>(&address), sizeof(address)) != 0 ||
      listen(listener.get(), 4) != 0)
    throw system_error("the virtual cameras' socket '" + text + "' cannot be made", errno);
  return listener;
}

}  // namespace

TruthServer::TruthServer(std::filesystem::path path) : path_(std::move(path)), listener_(listen_at(path_)) {}

TruthServer::~TruthServer() {
  std::error_code ignored;
  std::filesystem::remove(path_, ignored);
  for (const std::filesystem::path& link : links_) std::filesystem::remove(link, ignored);
}

void TruthServer::add_link(const std::filesystem::path& link) {
  std::error_code error;
  if (std::filesystem::is_symlink(link)) std::filesystem::remove(link, error);
  std::filesystem::create_symlink(std::filesystem::absolute(path_), link, error);
  if (error)
    throw Error(
        fmt::format("the virtual cameras' link '{}' cannot be made: {}", link.string(), error.message()));
  links_.push_back(link);
}

void TruthServer::accept_clients() {
  while (Descriptor client{accept4(listener_.get(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC)})
    clients_.push_back({std::move(client), "astrolabe-mocap 1\n"});
}

void TruthServer::send(const recording::TruthSample& sample) {
  if (clients_.empty()) return;
  const std::string line = fmt::format("{} {} {} {} {}\n", sample.time_us, sample.x_m, sample.y_m,
                                       sample.theta_rad, sample.valid ? 1 : 0);
  for (Client& client : clients_) client.waiting += line;
}

bool TruthServer::flush() {
  bool waiting = false;
  std::erase_if(clients_, [&](Client& client) {
    const ssize_t sent = client.waiting.empty() ? 0
                                                : ::send(client.socket.get(), client.waiting.data(),
                                                         client.waiting.size(), MSG_NOSIGNAL);
    const bool gone = (sent < 0 && errno != EAGAIN && errno != EINTR) || client.waiting.size() > kMostWaiting;
    if (gone) return true;
    if (sent > 0) client.waiting.erase(0, static_cast<std::size_t>(sent));
    waiting = waiting || !client.waiting.empty();
    return false;
  });
  return waiting;
}

}  // namespace astro::simulation
