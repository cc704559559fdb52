#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "common/protocol/frame.hpp"
#include "common/protocol/messages.hpp"
#include "host/robot/client/clock_map.hpp"
#include "host/robot/client/events.hpp"
#include "host/robot/client/receiver.hpp"
#include "host/robot/client/refusal.hpp"
#include "host/robot/client/retry_policy.hpp"
#include "host/robot/port/transport.hpp"

namespace astro::robot {

/// One robot at the other end of a Transport.
///
/// Replies  One request is under way at a time, besides at most one Ping. A request without an answer is sent
///          again under the same request id. This assumes that the robot remembers, per port, message id and
///          request id of the last request and its reply: if the same pair arrives again, it sends the same
///          reply and does not carry the request out again (except Hello and Ping, which may be repeated
///          without effect). So a lost AddSegment or a lost Ack never adds a segment twice. Nothing else is
///          sent between two tries, so one remembered reply is enough. A robot that restarts meanwhile
///          (Booted) has forgotten it; then the request fails with LinkLost.
/// Time     All from Transport::now(); waits only inside Transport::read().
/// Alive    While pump() runs, a Ping is sent 50 ms after the last request by the host's clock, or 50 ms
///          after the last answer by the robot's clock, because a simulator in fast motion stops its clock to
///          wait for us. A program that sends velocities makes no such pause, but only Pings map the clock, so
///          one is sent at the latest 200 ms after the one before. If the caller neither pumps nor requests,
///          a moving robot stops by its own time-out.
/// Errors   LinkLost: gone, silent or restarted. RobotRefused: ErrorReply. Error: the answer makes no sense.
class Client {
 public:
  explicit Client(std::unique_ptr<Transport> transport);
  explicit Client(Transport& transport);  // which must outlive the Client

  /// Handshake, after dropping old bytes; must be called first. Throws Error with the reason: no answer, not
  /// a robot, the line sends back what we send, another protocol version.
  const protocol::HelloReply& connect(RetryPolicy policy = {std::chrono::milliseconds(300), 5});

  /// Opens the same address again and shakes hands. Telemetry may have to be requested again. Throws LinkLost
  /// if the robot is not there in time, Error if another robot (unique_id) answers.
  void reconnect(microseconds timeout);

  /// The robot that answered connect().
  const protocol::HelloReply& robot() const { return robot_; }

  /// Sends, waits for the reply, repeats as described above. Events that arrive meanwhile go to their
  /// listeners.
  template <protocol::Request M>
  typename M::Reply request(const M& message, RetryPolicy policy = retry_policy_for<M>()) {
    const std::uint16_t id = next_id();
    const protocol::Frame frame(message, id);
    return understand<typename M::Reply>(exchange(frame.bytes(), id, M::kName, policy), M::kName);
  }

  /// Reads, dispatches and keeps the robot alive. pump_until returns true as soon as `done` does, which is
  /// called before the first read and after each message.
  void pump(microseconds duration);
  bool pump_until(const std::function<bool()>& done, microseconds timeout);

  /// M: Telemetry, SegmentStarted, SegmentDone, FaultRaised, Booted, SlipFound. Ends when the Subscription is destroyed.
  template <protocol::Message M>
  [[nodiscard]] Subscription on(typename Listeners<M>::Callback callback) {
    return std::get<Listeners<M>>(listeners_).add(std::move(callback));
  }

  /// Returns true if another host or program has stopped the robot since the previous call; the first call returns false. A
  /// program that drives several times must call this before each drive, because a stop between two drives also holds for
  /// the next one. The count survives reconnect().
  bool learns_of_stop(const protocol::Status& status) {
    const auto before = std::exchange(stops_known_, status.stops_by_others);
    return before && *before != status.stops_by_others;
  }

  microseconds now() const { return transport_.now(); }
  const std::string& name() const { return transport_.name(); }
  /// Newest time of the robot's clock in any message; 0 before the first.
  std::uint64_t device_time_us() const { return device_us_; }
  const ClockMap& clock() const { return clock_; }
  const LinkCounts& counts() const { return counts_; }
  const protocol::FrameCounts& frames() const { return receiver_.frames(); }

 private:
  using Body = std::span<const std::uint8_t>;
  struct Sent {
    std::uint16_t id = 0;
    microseconds at{};
  };

  template <class Reply>
  Reply understand(Body body, std::string_view request) {
    const auto reply = protocol::decode<Reply>(body);
    if (!reply.ok()) not_understood(request);
    if constexpr (requires { reply->device_time_us; }) note_device_time(reply->device_time_us);
    note_answer();
    return *reply;
  }

  std::uint16_t next_id() {
    // The id never has the onlooker bit, because requests with that bit do not keep a drive alive.
    return next_id_ = static_cast<std::uint16_t>(next_id_ + 1 == protocol::kOnlookerBit ? 1 : next_id_ + 1);
  }
  void send(Body frame);
  Body exchange(Body frame, std::uint16_t id, std::string_view request, RetryPolicy policy);
  std::optional<Body> ask(Body frame, std::uint16_t id, RetryPolicy policy);
  bool step(microseconds deadline);
  void dispatch(Body body);
  void dispatch_event(Body body);
  void take_pong(Body body);
  void keep_alive();
  microseconds next_ping() const;
  void note_device_time(std::uint64_t device_us);
  void note_answer();
  void forget();
  [[noreturn]] void not_understood(std::string_view request) const;
  [[noreturn]] void fail_silent(const std::string& when = {});

  std::unique_ptr<Transport> owned_;
  Transport& transport_;
  Receiver receiver_;
  protocol::HelloReply robot_;
  ClockMap clock_;
  LinkCounts counts_;
  std::tuple<Listeners<protocol::Telemetry>, Listeners<protocol::SegmentDone>,
             Listeners<protocol::FaultRaised>, Listeners<protocol::Booted>,
             Listeners<protocol::SegmentStarted>, Listeners<protocol::SlipFound>>
      listeners_;

  std::uint16_t next_id_ = 0;
  std::uint16_t waiting_for_ = 0;    // 0: no request is under way
  std::vector<std::uint8_t> reply_;  // to that request; empty until it arrives
  std::optional<Sent> ping_;         // under way
  int lost_pings_ = 0;               // in a row
  microseconds last_sent_{}, last_ping_{};
  std::uint64_t device_us_ = 0;               // newest seen
  std::uint64_t answered_device_us_ = 0;      // newest seen when the last answer came
  std::optional<std::uint16_t> stops_known_;  // Status::stops_by_others
  bool connecting_ = false;
  bool echo_ = false;  // the line sends back what we send
};

}  // namespace astro::robot
