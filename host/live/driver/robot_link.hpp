#pragma once

#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "host/live/driver/host_clock.hpp"
#include "host/robot/client/client.hpp"
#include "host/robot/parameters/parameters.hpp"

namespace astro::live {

/// One connection to a robot, from the handshake until it is lost: its parameters and the stream of its telemetry. Requests
/// time out after half a second, and a parameter commit, for which the robot may have to erase flash, after two seconds, so
/// that nobody waits longer for the driver. The parameter table is read later, so that the robot can be stopped at once.
class RobotSession {
 public:
  static constexpr robot::RetryPolicy kPatience{std::chrono::milliseconds(60), 8};

  /// Shakes hands and asks for telemetry. Throws astro::Error with the reason if no robot answers, or another one than `known`.
  RobotSession(std::unique_ptr<robot::Transport> transport, const std::optional<protocol::HelloReply>& known,
               protocol::SetTelemetry telemetry);

  template <protocol::Request M>
  typename M::Reply ask(const M& message) {
    return client_->request(message, kPatience);
  }

  /// Waits until telemetry or an event has come, at most this long.
  void pump(microseconds most);
  /// The next sample of telemetry in the order in which they came.
  std::optional<protocol::Telemetry> take_sample();

  /// The robot's clock in microseconds, read just now.
  std::uint64_t device_now_us() { return ask(protocol::Ping{}).device_time_us; }
  /// Stops a robot that drives although no program here drives it (host/robot/motion/other_program.hpp); whether it was stopped.
  bool stop_left_drive();
  /// Asks for this telemetry from now on.
  void ask_for_telemetry(protocol::SetTelemetry telemetry);
  /// Asks for telemetry again if none has come for half a second and for five periods.
  void keep_telemetry();

  bool restarted() const { return restarted_; }
  /// True once after a fault was raised.
  bool take_fault() { return std::exchange(fault_, false); }

  robot::Client& client() { return *client_; }
  /// Reads at least one parameter of the table, and more until `most` has passed. True if all are known.
  bool read_parameters(microseconds most);
  bool knows_parameters() const { return parameters_.is_complete(); }
  robot::RemoteParameters& parameters() { return parameters_; }
  /// The parameters by name. Before all are known, it holds only the command time-out.
  const std::map<std::string, double>& numbers() const { return numbers_; }
  /// To be called after the parameters have changed.
  void note_parameters() { numbers_ = parameters_.numbers(); }
  microseconds telemetry_age() const { return client_->now() - telemetry_at_; }

 private:
  static std::unique_ptr<robot::Client> connected(std::unique_ptr<robot::Transport> transport,
                                                  const std::optional<protocol::HelloReply>& known);

  std::unique_ptr<robot::Client> client_;
  protocol::SetTelemetry wanted_;
  robot::RemoteParameters parameters_;
  std::map<std::string, double> numbers_;
  std::deque<protocol::Telemetry> samples_;
  microseconds telemetry_at_{}, asked_at_{};
  bool restarted_ = false, fault_ = false;
  robot::Subscription on_telemetry_, on_fault_, on_boot_;
};

/// Opens the robot's port; throws astro::Error with the reason if that is not possible now.
using OpenPort = std::function<std::unique_ptr<robot::Transport>()>;

/// The link to one robot, which may not be there yet, and may go away and come back. It belongs to the first robot that
/// answers. Another robot at the same port is refused, because its odometry and its parameters are different.
class RobotLink {
 public:
  RobotLink(OpenPort open, HostClock clock, protocol::SetTelemetry telemetry)
      : open_(std::move(open)), clock_(std::move(clock)), telemetry_(telemetry) {}

  /// Null while there is no robot.
  RobotSession* session() { return session_.get(); }

  /// Tries to reach the robot, if it is time for another try. True if there is a new session now.
  bool seek();
  /// Ends the session, for this reason.
  void lose(const Error& why);
  /// Asks the robot for this telemetry, now if it is there, and whenever it is found.
  void ask_for_telemetry(protocol::SetTelemetry telemetry);

  /// Why there is no session.
  const Error& why() const { return why_; }
  /// The robot that answered first.
  const std::optional<protocol::HelloReply>& robot() const { return robot_; }
  /// How many times it was lost.
  int losses() const { return losses_; }

 private:
  OpenPort open_;
  HostClock clock_;
  protocol::SetTelemetry telemetry_;
  std::unique_ptr<RobotSession> session_;
  std::optional<protocol::HelloReply> robot_;
  Error why_{"no robot was found yet"};
  std::optional<microseconds> tried_;
  int losses_ = 0;
};

}  // namespace astro::live
