#pragma once

#include <atomic>
#include <deque>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "host/base/descriptor.hpp"
#include "host/base/error.hpp"
#include "host/robot/sharing/relay.hpp"

namespace astro::robot {

/// The descriptors of a relay.
struct SharedLine {
  Descriptor line;      // to the robot; non-blocking
  Descriptor listener;  // empty if other programs cannot connect
};

/// A Relay on a thread of its own, so that a program that computes, prints or waits at a prompt still serves
/// the others, above all an emergency stop.
///
/// End  The destructor closes the line and sends the other programs a Farewell. To go on serving them, call
///      serve_others_only() once this program no longer needs the line, and leave_behind() at its end.
class RelayServer {
 public:
  explicit RelayServer(SharedLine shared);
  ~RelayServer();
  RelayServer(const RelayServer&) = delete;
  RelayServer& operator=(const RelayServer&) = delete;

  /// Goes on only until the last other program has gone, then closes the line. Returns false and serves nobody
  /// if there is none, or if the line is lost.
  bool serve_others_only();

  /// Serves nobody until leave_behind().
  void stop();

  /// If other programs use the line, leaves a process behind that goes on as serve_others_only() does. If
  /// that fails, their connections end. This process serves nobody from then on. Precondition: it has no
  /// other thread, so every RelayServer of it has been stopped.
  void leave_behind();

  /// A connection for this program itself; it gets neither Welcome nor Farewell.
  Descriptor connect_self();

  /// The line is lost, and all programs have been notified.
  bool lost() const { return lost_; }
  /// Other programs are connected.
  bool has_guests() const { return guests_ > 0; }
  /// Why connect_self()'s connection has ended.
  Remark why_ended() const;

 private:
  struct Connection {
    Descriptor socket;
    SessionId session = 0;
    bool guest = true;
    std::optional<microseconds> closing_since;
    bool told = false;  // its Farewell has been written
  };

  void start(void (RelayServer::*work)());
  void run();
  void serve_guests();
  void turn();
  void take_new_connections();
  void accept_guest();
  void add(Descriptor socket, PortUser user, bool guest);
  void read_line();
  void write_line();
  void read_from(Connection& connection);
  /// False once the connection has ended.
  bool write_to(Connection& connection);
  void end_connections();
  void lose_line();
  int milliseconds_to_wait() const;

  SharedLine shared_;
  Relay relay_;  // used by the thread only
  std::deque<Connection> connections_;
  std::optional<microseconds> line_blocked_since_;
  microseconds accept_from_{};  // accept no guest before this time, because no descriptor was free

  Descriptor wake_;
  std::mutex mutex_;
  std::vector<Descriptor> arriving_;  // under mutex_
  std::atomic<bool> stop_ = false, lost_ = false;
  std::atomic<int> guests_ = 0;
  std::atomic<int> own_end_ = -1;  // a FarewellReason
  std::thread thread_;
};

}  // namespace astro::robot
