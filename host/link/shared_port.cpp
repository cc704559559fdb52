#include "host/link/shared_port.hpp"

#include <fcntl.h>
#include <sys/file.h>

#include <boost/asio/local/stream_protocol.hpp>
#include <chrono>
#include <optional>
#include <thread>

#include "host/link/port_socket.hpp"
#include "host/link/ports.hpp"
#include "host/link/relay_server.hpp"
#include "host/link/serial_port.hpp"
#include "host/link/stream_transport.hpp"

namespace astro::link {

namespace {

using boost::asio::local::stream_protocol;
using std::chrono::milliseconds;

constexpr microseconds kGreeting = milliseconds(1000);  // an idle holder greets within a millisecond
// Between a holder's lock and its socket, and between its end and the lock's.
constexpr microseconds kStart = milliseconds(1000);
constexpr milliseconds kPause(5);

/// The way of one program to a port: through its own relay or through that of another program.
class SharedPort {
 public:
  SharedPort(std::string address, unsigned baud) : address_(std::move(address)), baud_(baud) {}

  Descriptor open() {
    if (server_ && !server_->lost() && server_->has_guests()) return server_->connect_self();
    server_.reset();
    holder_.reset();
    const auto deadline = std::chrono::steady_clock::now() + kStart;
    while (true) {
      try {
        return hold();
      } catch (const PortInUse& used) {
        if (Descriptor connection = join(used.key())) return connection;
        if (std::chrono::steady_clock::now() >= deadline) throw;
      }
      std::this_thread::sleep_for(kPause);
    }
  }

  std::string why_lost() const {
    if (server_) return server_->why_ended();
    return "the program that held the port" +
           (holder_ ? " (" + in_words(holder_->pid, holder_->command) + ")" : std::string()) + " has ended";
  }

  std::string why_silent() const {
    if (server_ || socket_.empty()) return {};
    const Served probe = connect_to(socket_, kGreeting / 2);
    return probe.busy ? does_not_answer(*probe.busy) : std::string();
  }

 private:
  Descriptor hold() {
    SharedLine shared;
    if (address_.starts_with("tcp:")) shared.lock = lock_tcp();
    shared.line.reset(open_line(address_, baud_));
    // Where nobody can be let in the port is still this program's.
    try {
      make_runtime_folder();
      const auto socket = socket_of(key_of(shared));
      shared.listener = listen_at(socket);
      shared.socket = socket;
    } catch (const Error&) {
    }
    server_ = std::make_unique<RelayServer>(std::move(shared));
    return server_->connect_self();
  }

  std::string key_of(const SharedLine& shared) const {
    return address_.starts_with("tcp:") ? tcp_key(address_) : port_key_of(shared.line.get());
  }

  /// A TCP address has no file to lock; one in the runtime folder stands for it.
  Descriptor lock_tcp() const {
    const std::string key = tcp_key(address_);
    const auto file = runtime_folder() / (key + ".lock");
    try {
      make_runtime_folder();
    } catch (const Error&) {
      return {};  // nobody can be let in, and nobody kept out
    }
    Descriptor lock(::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0600));
    if (!lock) throw Error("the file '" + file.string() + "' cannot be opened: remove it");
    if (::flock(lock.get(), LOCK_EX | LOCK_NB) != 0)
      throw PortInUse(address_ + " is in use by another program: end that one first", key);
    return lock;
  }

  /// Nothing if the holder does not share the port, or has just ended.
  Descriptor join(const std::string& key) {
    const auto socket = socket_of(key);
    Served served = connect_to(socket, kGreeting);
    if (served.busy) throw Error(address_ + ": " + does_not_answer(*served.busy));
    if (served.connection) {
      socket_ = socket;
      holder_ = peer_of(served.connection);
    }
    return std::move(served.connection);
  }

  std::string address_;
  unsigned baud_;
  std::unique_ptr<RelayServer> server_;  // of a program that holds the port
  std::filesystem::path socket_;         // of a program that another one serves
  std::optional<PortUser> holder_;
};

}  // namespace

std::unique_ptr<Transport> open_shared_port(const std::string& address, unsigned baud) {
  if (address.empty()) return open_transport(address, baud);  // which says so
  using Stream = StreamTransport<stream_protocol::socket>;
  const auto port = std::make_shared<SharedPort>(address, baud);
  return std::make_unique<Stream>(
      address,
      [port](boost::asio::io_context& context) {
        stream_protocol::socket socket(context, stream_protocol(), port->open().release());
        socket.non_blocking(true);
        return socket;
      },
      Stream::Sentences{[port] { return port->why_lost(); }, [port] { return port->why_silent(); }});
}

}  // namespace astro::link
