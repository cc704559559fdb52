#include "host/live/web/server.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/address.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <chrono>
#include <mutex>
#include <thread>
#include <utility>

#include "host/base/blocked_signals.hpp"
#include "host/base/error.hpp"
#include "host/live/web/connection.hpp"

namespace astro::web {
namespace {

namespace asio = boost::asio;
using asio::ip::tcp;
using boost::system::error_code;

constexpr std::size_t kMostConnections = 64;  // with those that are not clients yet
constexpr std::size_t kMostLeaving = 16;      // beyond them: told to go, and not gone yet
constexpr std::chrono::seconds kStuck{3};     // a client that has read nothing for so long may have to go
constexpr std::size_t kMostTasks = 10'000;
constexpr std::chrono::milliseconds kReportPeriod{250}, kGoodbyeTime{200}, kRestAfterFailure{100};

tcp::acceptor listening(asio::io_context& io, const Address& wanted) {
  error_code error;
  const auto ip = asio::ip::make_address(wanted.ip, error);
  if (error) throw Error(fmt::format("'{}' is not an address of a network", wanted.ip));
  const tcp::endpoint endpoint(ip, wanted.port);
  tcp::acceptor acceptor(io);
  acceptor.open(endpoint.protocol(), error);
  if (!error) acceptor.set_option(tcp::acceptor::reuse_address(true), error);
  if (!error) acceptor.bind(endpoint, error);
  if (!error) acceptor.listen(asio::socket_base::max_listen_connections, error);
  if (error)
    throw Error(fmt::format("cannot listen at {}, port {}: {}", wanted.ip, wanted.port, error.message()),
                error == asio::error::address_in_use ? Kind(ServerProblem::port_taken) : Kind(),
                {std::to_string(wanted.port)});
  return acceptor;
}

}  // namespace

class Server::Impl {
 public:
  Impl(const Address& address, Site& site)
      : site_(site), acceptor_(listening(io_, address)), report_timer_(io_), rest_timer_(io_) {}

  ~Impl() {
    if (!thread_.joinable()) return;
    asio::post(io_, [this] { say_goodbye(); });
    thread_.join();
  }

  std::uint16_t port() const { return acceptor_.local_endpoint().port(); }

  void start() {
    if (thread_.joinable()) return;
    const BlockedSignals blocked;  // signals are for the robot's thread
    thread_ = std::thread([this] { run(); });
  }

  void post(Task task) {
    const std::lock_guard lock(mutex_);
    tasks_.push_back(std::move(task));
    wake();
  }

  void post_data(Task task) {
    const std::lock_guard lock(mutex_);
    if (tasks_.size() < kMostTasks) tasks_.push_back(std::move(task));
  }

  void flush() {
    const std::lock_guard lock(mutex_);
    if (!tasks_.empty()) wake();
  }

  /// The caller may be iterating over the connections, so none is erased.
  void dismiss_stuck_watcher() {
    Connection* stuck = nullptr;
    for (const auto& each : connections_)
      if (each->watches() && each->stuck_since() &&
          (stuck == nullptr || *each->stuck_since() < *stuck->stuck_since()))
        stuck = each.get();
    if (stuck != nullptr && Connection::Clock::now() - *stuck->stuck_since() >= kStuck)
      stuck->dismiss(
          {"it did not read what it watched, and another one wants to watch", ViewerProblem::stuck});
  }

 private:
  void run() {
    while (true) try {
        begin();
        io_.run();
        return;
      } catch (const std::exception& error) {  // of any handler, such as no memory
        say(error);
      }
  }

  /// The callback may throw as well, which must not end the server.
  void say(const std::exception& error) noexcept {
    try {
      site_.notice({fmt::format("a viewer could not be served: {}", error.what())});
    } catch (const std::exception&) {
    }
  }

  /// Called at the start, and after a handler has thrown. If that handler accepted viewers or reported to them, it has not
  /// started its next round, so that is done here. If the server is closing, it stops, so that it does not keep the program
  /// from ending.
  void begin() {
    if (closing_) return io_.stop();
    if (!accepts_) accept();
    if (!reports_) report_later();
  }

  /// Precondition: the caller holds mutex_.
  void wake() {
    if (!std::exchange(awake_, true)) asio::post(io_, [this] { work(); });
  }

  void work() {
    std::vector<Task> tasks;
    {
      const std::lock_guard lock(mutex_);
      tasks.swap(tasks_);
      awake_ = false;
    }
    for (const Task& task : tasks) try {
        task();
      } catch (const std::exception& error) {
        say(error);  // and the tasks behind it are done all the same
      }
    send_waiting();
  }

  void send_waiting() {
    for (const auto& connection : connections_) connection->send_waiting();
    std::erase_if(connections_, [](const auto& connection) { return connection->ended(); });
  }

  void accept() {
    acceptor_.async_accept([this](error_code error, tcp::socket socket) {
      accepts_ = false;
      if (error == asio::error::operation_aborted) return;
      if (error) return accept_later();  // no descriptor is free, for one
      send_waiting();                    // forgets those that have ended
      if (connections_.size() >= kMostConnections) dismiss_idlest();
      if (connections_.size() < kMostConnections + kMostLeaving) {
        connections_.push_back(make_connection(std::move(socket), site_));
        connections_.back()->start();
      }
      accept();
    });
    accepts_ = true;
  }

  /// Disconnects the client that watches nothing and has been silent for longest. There is always one, because fewer may
  /// watch than may be connected. So a client that wants to stop the robot can always connect.
  void dismiss_idlest() {
    Connection* idlest = nullptr;
    for (const auto& each : connections_)
      if (!each->watches() && (idlest == nullptr || each->heard_at() < idlest->heard_at()))
        idlest = each.get();
    if (idlest != nullptr)
      idlest->dismiss({"it watched nothing, and another one wants to connect", ViewerProblem::idle});
    std::erase_if(connections_, [](const auto& connection) { return connection->ended(); });
  }

  void accept_later() {
    rest_timer_.expires_after(kRestAfterFailure);
    rest_timer_.async_wait([this](error_code error) {
      accepts_ = false;
      if (!error) accept();
    });
    accepts_ = true;
  }

  void report_later() {
    report_timer_.expires_after(kReportPeriod);
    report_timer_.async_wait([this](error_code error) {
      reports_ = false;
      if (error) return;
      site_.report();
      send_waiting();
      report_later();
    });
    reports_ = true;
  }

  void say_goodbye() {
    closing_ = true;
    error_code ignored;
    acceptor_.close(ignored);
    rest_timer_.cancel();
    for (const auto& connection : connections_) connection->close();
    report_timer_.expires_after(kGoodbyeTime);  // ends the reports
    report_timer_.async_wait([this](error_code) { io_.stop(); });
    wait_for_end();
  }

  /// Stops as soon as nobody is connected any more.
  void wait_for_end() {
    std::erase_if(connections_, [](const auto& connection) { return connection->ended(); });
    if (connections_.empty()) return io_.stop();
    rest_timer_.expires_after(std::chrono::milliseconds(5));
    rest_timer_.async_wait([this](error_code) { wait_for_end(); });
  }

  Site& site_;
  asio::io_context io_{1};
  tcp::acceptor acceptor_;
  asio::steady_timer report_timer_, rest_timer_;
  std::vector<std::shared_ptr<Connection>> connections_;
  bool accepts_ = false, reports_ = false;  // or waits to do so
  bool closing_ = false;
  std::mutex mutex_;
  std::vector<Task> tasks_;  // under mutex_
  bool awake_ = false;       // under mutex_: work() has been posted
  std::thread thread_;
};

Server::Server(const Address& address, Site& site) : impl_(std::make_unique<Impl>(address, site)) {}
Server::~Server() = default;

std::uint16_t Server::port() const { return impl_->port(); }
void Server::start() { impl_->start(); }
void Server::post(Task task) { impl_->post(std::move(task)); }
void Server::post_data(Task task) { impl_->post_data(std::move(task)); }
void Server::flush() { impl_->flush(); }
void Server::dismiss_stuck_watcher() { impl_->dismiss_stuck_watcher(); }

}  // namespace astro::web
