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
/// End  The destructor closes the line. If other programs still use it, a process that this one leaves behind
///      goes on serving them, and ends with the last of them.
class RelayServer {
 public:
  explicit RelayServer(SharedLine shared);
  ~RelayServer();
  RelayServer(const RelayServer&) = delete;
  RelayServer& operator=(const RelayServer&) = delete;

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

  void start();
  void stop();
  void run();
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
  void serve_in_background();

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
