#include "host/robot/sharing/shared_port.hpp"

#include <boost/asio/local/stream_protocol.hpp>
#include <chrono>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "host/robot/port/serial_port.hpp"
#include "host/robot/port/stream_transport.hpp"
#include "host/robot/sharing/port_socket.hpp"
#include "host/robot/sharing/relay_server.hpp"

namespace astro::robot {

/// The ports that this program has closed and other programs still use.
class ClosedPorts {
 public:
  void add(std::unique_ptr<RelayServer> server) {
    if (!server || !server->serve_others_only()) return;
    const std::lock_guard lock(mutex_);
    std::erase_if(servers_, [](const auto& other) { return other->lost(); });
    servers_.push_back(std::move(server));
  }

  void leave_to_others() {
    const std::lock_guard lock(mutex_);
    // A process is left behind only once this one has no other thread.
    for (const auto& server : servers_) server->stop();
    for (const auto& server : servers_) server->leave_behind();
    servers_.clear();
  }

 private:
  std::mutex mutex_;
  std::vector<std::unique_ptr<RelayServer>> servers_;
};

namespace {

using boost::asio::local::stream_protocol;
using std::chrono::milliseconds;

constexpr microseconds kGreeting = milliseconds(1000);  // an idle holder greets within a millisecond
// Longest time between a holder's lock and its socket, and between its end and the release of the lock.
constexpr microseconds kStart = milliseconds(1000);
constexpr milliseconds kPause(5);

/// The connection of one program to a port: through its own relay or through that of another program.
class SharedPort {
 public:
  SharedPort(std::string address, unsigned baud, Notice notice, std::shared_ptr<ClosedPorts> closed)
      : address_(std::move(address)), baud_(baud), notice_(std::move(notice)), closed_(std::move(closed)) {}
  ~SharedPort() { closed_->add(std::move(server_)); }
  SharedPort(const SharedPort&) = delete;
  SharedPort& operator=(const SharedPort&) = delete;

  Descriptor open() {
    if (server_ && !server_->lost() && server_->has_guests()) return server_->connect_self();
    closed_->add(std::move(server_));
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

  Remark why_lost() const {
    if (server_) return server_->why_ended();
    if (!holder_) return {"the program that held the port has ended", SharingProblem::holder_ended};
    return {"the program that held the port (" + in_words(holder_->pid, holder_->command) + ") has ended",
            SharingProblem::holder_ended,
            {std::to_string(holder_->pid)}};
  }

  Remark why_silent() const {
    if (server_ || key_.empty()) return {};
    const HolderConnection probe = connect_to(key_, kGreeting / 2);
    return probe.busy ? holder_hangs(*probe.busy) : Remark{};
  }

 private:
  bool is_tcp() const { return address_.starts_with("tcp:"); }

  Descriptor hold() {
    SharedLine shared;
    if (is_tcp()) {
      shared.listener = hold_tcp();
      shared.line = open_line(address_, baud_);
    } else {
      shared.line = open_line(address_, baud_);
      try {
        shared.listener = listen_at(port_key_of(shared.line.get()));
      } catch (const Error& error) {  // this program can use the port anyway
        notice_({address_ + ": no other program can stop or watch this robot meanwhile; " + error.what(),
                 SharingProblem::not_shared,
                 {address_}});
      }
    }
    server_ = std::make_unique<RelayServer>(std::move(shared));
    return server_->connect_self();
  }

  /// A TCP address has no file to lock; the name of its socket serves as the lock.
  Descriptor hold_tcp() const {
    const std::string key = tcp_key(address_);
    try {
      return listen_at(key);
    } catch (const Error& error) {
      throw PortInUse(
          address_ + " is in use by another program, which does not share it (" + error.what() + ")",
          address_, key);
    }
  }

  /// Empty if the holder does not share the port, or has just ended.
  Descriptor join(const std::string& key) {
    HolderConnection served = connect_to(key, kGreeting);
    if (served.busy) {
      throw Error(holder_hangs(*served.busy).in(address_ + ": "));
    }
    if (served.connection) {
      key_ = key;
      holder_ = peer_of(served.connection);
    }
    return std::move(served.connection);
  }

  std::string address_;
  unsigned baud_;
  Notice notice_;
  std::shared_ptr<ClosedPorts> closed_;
  std::unique_ptr<RelayServer> server_;  // set if this program holds the port
  std::string key_;                      // set if another program serves this one
  std::optional<PortUser> holder_;
};

}  // namespace

SharedPorts::SharedPorts() : closed_(std::make_shared<ClosedPorts>()) {}

void SharedPorts::leave_to_others() { closed_->leave_to_others(); }

std::unique_ptr<Transport> SharedPorts::open(const std::string& address, unsigned baud, Notice notice) {
  if (address.empty()) return open_transport(address, baud);  // which throws the error
  using Stream = StreamTransport<stream_protocol::socket>;
  const auto port = std::make_shared<SharedPort>(address, baud, std::move(notice), closed_);
  return std::make_unique<Stream>(
      address,
      [port](boost::asio::io_context& context) {
        Descriptor line = port->open();
        stream_protocol::socket socket(context, stream_protocol(), line.get());
        line.release();
        socket.non_blocking(true);
        return socket;
      },
      Stream::Sentences{[port] { return port->why_lost(); }, [port] { return port->why_silent(); }});
}

}  // namespace astro::robot
