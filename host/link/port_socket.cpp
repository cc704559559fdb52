#include "host/link/port_socket.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/file.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <fstream>
#include <iterator>

#include "host/base/error.hpp"
#include "host/link/ports.hpp"
#include "host/link/relay_messages.hpp"

namespace astro::link {

namespace fs = std::filesystem;

namespace {

constexpr const char* kExtension = ".socket";

/// A socket's address holds 107 characters, a path may be longer: through its open folder it is always short.
class SocketAddress {
 public:
  explicit SocketAddress(const fs::path& path)
      : folder_(::open(path.parent_path().c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC)) {
    address_.sun_family = AF_UNIX;
    const std::string name =
        "/proc/self/fd/" + std::to_string(folder_.get()) + "/" + path.filename().string();
    fits_ = folder_ && name.size() < sizeof(address_.sun_path);
    if (fits_) name.copy(address_.sun_path, name.size());
  }
  bool usable() const { return fits_; }
  const sockaddr* get() const { return reinterpret_cast<const sockaddr*>(&address_); }
  static socklen_t size() { return sizeof(sockaddr_un); }

 private:
  Descriptor folder_;
  sockaddr_un address_{};
  bool fits_ = false;
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

/// Reads the first frame and not a byte more.
Greeting wait_for_greeting(const Descriptor& connection, microseconds patience) {
  const auto deadline = std::chrono::steady_clock::now() + patience;
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

/// Keeps others from sweeping away what takes a dead socket's place at this moment. Nothing if somebody holds
/// the lock for long, which only a stopped program does.
Descriptor lock_folder(const fs::path& path) {
  constexpr int kTries = 50;
  Descriptor folder(::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  for (int i = 0; i < kTries; ++i) {
    if (::flock(folder.get(), LOCK_EX | LOCK_NB) == 0) return folder;
    ::poll(nullptr, 0, 5);
  }
  return {};
}

/// Takes away the sockets of dead programs, whose ports may never come back under the same name.
void sweep(const fs::path& folder) {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const fs::path& path = entry.path();
    if (path.extension() != kExtension || !path.filename().string().starts_with("port-")) continue;
    const SocketAddress address(path);
    const Descriptor probe = new_socket();
    if (!address.usable() || !probe) return;
    if (::connect(probe.get(), address.get(), SocketAddress::size()) != 0 && errno == ECONNREFUSED)
      ::unlink(path.c_str());
  }
}

}  // namespace

fs::path socket_of(const std::string& port_key) { return runtime_folder() / (port_key + kExtension); }

Descriptor listen_at(const fs::path& socket) {
  constexpr int kBacklog = 16;
  const Descriptor folder = lock_folder(socket.parent_path());
  if (folder) sweep(socket.parent_path());
  const fs::path fresh = socket.string() + "." + std::to_string(::getpid());
  const SocketAddress address(fresh);
  Descriptor listener = new_socket();
  ::unlink(fresh.c_str());
  // The mode comes from the open socket, so that the file never has another one.
  if (!address.usable() || !listener || ::fchmod(listener.get(), 0600) != 0 ||
      ::bind(listener.get(), address.get(), SocketAddress::size()) != 0 ||
      ::listen(listener.get(), kBacklog) != 0 || ::rename(fresh.c_str(), socket.c_str()) != 0) {
    const std::string why = std::strerror(errno);
    ::unlink(fresh.c_str());
    throw Error("the socket '" + socket.string() + "' cannot be made: " + why);
  }
  return listener;
}

void remove_socket(const fs::path& socket) { ::unlink(socket.c_str()); }

std::optional<PortUser> peer_of(const Descriptor& connection) {
  const auto peer = credentials(connection);
  if (!peer || peer->uid != ::geteuid()) return std::nullopt;
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

std::string in_words(std::uint32_t pid, std::string_view command) {
  return "process id " + std::to_string(pid) +
         (command.empty() ? std::string() : ", '" + std::string(command) + "'");
}

Served connect_to(const fs::path& socket, microseconds patience) {
  const SocketAddress address(socket);
  Descriptor connection = new_socket();
  if (!address.usable() || !connection) return {};
  const bool connected = ::connect(connection.get(), address.get(), SocketAddress::size()) == 0;
  if (!connected && errno != EAGAIN) return {};
  const auto holder = connected ? peer_of(connection) : std::optional<PortUser>(PortUser{});
  if (!holder) return {};
  const Greeting greeting = connected ? wait_for_greeting(connection, patience) : Greeting::none;
  if (greeting == Greeting::came) return {std::move(connection), std::nullopt};
  if (greeting == Greeting::ended) return {};
  return {{}, holder};
}

std::string does_not_answer(const PortUser& holder) {
  if (holder.pid == 0) return "the program that holds the port does not answer: let it go on, or end it";
  return "the program with " + in_words(holder.pid, holder.command) +
         " holds the port and does not answer: let it go on, or end it with 'kill -9 " +
         std::to_string(holder.pid) + "'";
}

}  // namespace astro::link
