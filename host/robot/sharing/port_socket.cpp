#include "host/robot/sharing/port_socket.hpp"

#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>

#include <cerrno>
#include <chrono>
#include <cstddef>
#include <fstream>
#include <iterator>

#include "common/protocol/codec.hpp"
#include "common/protocol/framer.hpp"
#include "host/base/error.hpp"
#include "host/base/system_error.hpp"
#include "host/robot/sharing/relay_messages.hpp"

namespace astro::robot {

namespace {

/// An abstract address: the name begins with a zero byte and has no file.
class SocketAddress {
 public:
  explicit SocketAddress(const std::string& port_key) {
    const std::string name = "astrolabe-" + port_key;
    address_.sun_family = AF_UNIX;
    const std::size_t length = name.copy(address_.sun_path + 1, sizeof(address_.sun_path) - 1);
    size_ = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + length);
  }
  const sockaddr* get() const { return reinterpret_cast<const sockaddr*>(&address_); }
  socklen_t size() const { return size_; }

 private:
  sockaddr_un address_{};
  socklen_t size_;
};

Descriptor new_socket() {
  return Descriptor(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
}

std::optional<ucred> credentials(const Descriptor& connection) {
  ucred peer{};
  socklen_t size = sizeof peer;
  if (::getsockopt(connection.get(), SOL_SOCKET, SO_PEERCRED, &peer, &size) != 0) return std::nullopt;
  return peer;
}

enum class Greeting : std::uint8_t { came, none, ended };

/// Reads the first frame and no byte after it.
Greeting wait_for_greeting(const Descriptor& connection, microseconds timeout) {
  const auto deadline = std::chrono::steady_clock::now() + timeout;
  protocol::Framer framer;
  while (true) {
    const auto left =
        std::chrono::duration_cast<std::chrono::milliseconds>(deadline - std::chrono::steady_clock::now());
    pollfd ready{connection.get(), POLLIN, 0};
    if (left.count() <= 0 || ::poll(&ready, 1, static_cast<int>(left.count()) + 1) < 0) return Greeting::none;
    std::uint8_t byte = 0;
    const auto size = ::recv(connection.get(), &byte, 1, 0);
    if (size == 0 || (size < 0 && errno != EAGAIN)) return Greeting::ended;
    if (size < 0) continue;
    if (const auto body = framer.push(byte))
      return protocol::decode<Welcome>(*body).ok() ? Greeting::came : Greeting::ended;
  }
}

}  // namespace

Descriptor listen_at(const std::string& port_key) {
  constexpr int kBacklog = 16;
  const SocketAddress address(port_key);
  Descriptor listener = new_socket();
  if (!listener || ::bind(listener.get(), address.get(), address.size()) != 0 ||
      ::listen(listener.get(), kBacklog) != 0)
    throw system_error("the socket for other programs cannot be made", errno);
  return listener;
}

std::optional<PortUser> peer_of(const Descriptor& connection) {
  const auto peer = credentials(connection);
  if (!peer || (peer->uid != ::geteuid() && peer->uid != 0)) return std::nullopt;
  return describe_process(peer->pid);
}

PortUser describe_process(pid_t pid) {
  std::ifstream file("/proc/" + std::to_string(pid) + "/cmdline", std::ios::binary);
  std::string line((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  while (!line.empty() && line.back() == '\0') line.pop_back();
  const std::string program = line.substr(0, line.find('\0'));
  if (const auto slash = program.rfind('/'); slash != std::string::npos) line.erase(0, slash + 1);
  for (char& c : line) c = c == '\0' ? ' ' : (c < ' ' || c > '~') ? '?' : c;
  if (line.size() > CommandLine::kCapacity) line = line.substr(0, CommandLine::kCapacity - 3) + "...";
  return {static_cast<std::uint32_t>(pid), line};
}

HolderConnection connect_to(const std::string& port_key, microseconds timeout) {
  const SocketAddress address(port_key);
  Descriptor connection = new_socket();
  if (!connection) throw system_error("the program that holds the port cannot be asked", errno);
  const bool connected = ::connect(connection.get(), address.get(), address.size()) == 0;
  if (!connected && errno != EAGAIN) return {};
  std::optional<PortUser> holder = connected ? peer_of(connection) : PortUser{};
  if (!holder && ::geteuid() == 0) holder = PortUser{};  // root may stop any user's robot
  if (!holder) return {};
  const Greeting greeting = connected ? wait_for_greeting(connection, timeout) : Greeting::none;
  if (greeting == Greeting::came) return {std::move(connection), std::nullopt};
  if (greeting == Greeting::ended) return {};
  return {{}, holder};
}

Remark holder_hangs(const PortUser& holder) {
  if (holder.pid == 0)
    return {"the program that holds the port does not answer: let it go on, or end it",
            SharingProblem::holder_hangs};
  const std::string pid = std::to_string(holder.pid);
  return {"the program with " + in_words(holder.pid, holder.command) +
              " holds the port and does not answer: let it go on, or end it with 'kill -9 " + pid + "'",
          SharingProblem::holder_hangs,
          {pid}};
}

}  // namespace astro::robot
