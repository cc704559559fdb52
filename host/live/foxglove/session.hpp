#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>

#include "host/live/foxglove/catalogue.hpp"
#include "host/live/foxglove/client_messages.hpp"
#include "host/live/foxglove/client_queue.hpp"
#include "host/live/foxglove/requests.hpp"

namespace astro::foxglove {

/// Limits how many clients subscribe at a time, because megabytes may wait for each of them. All others may still ask
/// questions and stop the robot.
struct Watchers {
  static constexpr std::size_t kMost = 16;

  std::size_t now = 0;
  /// Called when one client too many wants to subscribe. It may disconnect one that does not read what it has subscribed to.
  std::function<void()> make_room = [] {};
};

/// One client: what it subscribes, publishes and watches. Does no I/O and has no clock.
///
/// Errors  what is wrong in a message is said to the client in a `status` (or a serviceCallFailure), and the rest of the message
///         counts; the connection stays.
/// Bounds  a channel is subscribed once, and by no more clients than Watchers allows; 256 advertised channels; 64 questions
///         to the robot at a time, further ones are refused. What is sent is bounded by ClientQueue.
class Session {
 public:
  static constexpr std::size_t kMostAdvertised = 256;
  static constexpr int kMostQuestions = 64;
  static constexpr std::size_t kLongestQuestion = 16 * 1024;  // in bytes; so 1 MiB waits for a client at most

  /// `catalogue` and `watchers` must outlive it. What the client asks of the robot goes to `sink`.
  Session(ClientId id, const Catalogue& catalogue, Watchers& watchers, RequestSink sink);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  ClientId id() const { return id_; }
  ClientQueue& queue() { return queue_; }
  /// Whether it has subscribed to anything.
  bool watches() const { return !subscription_of_.empty(); }

  /// Takes one WebSocket message of the client, which may be any bytes.
  void receive(bool is_text, ByteView message);

  /// A new message of a channel; it is queued if the client subscribes to it.
  void offer(const Channel& channel, const SharedSample& sample);
  /// The robot's answer to a question of this client.
  void answer_text(std::string text);
  void answer_binary(std::string bytes);
  /// Parameters that have changed; those that the client watches are sent.
  void parameters_changed(std::span<const ros2::msg::Parameter> parameters);

  bool watches_parameters() const { return watches_all_ || !watched_.empty(); }
  bool watches_graph() const { return graph_sent_.has_value(); }
  void send_graph(const ConnectionGraph& graph);
  void add_to(ConnectionGraph& graph) const;
  /// Says how many messages were dropped since the last call, if there were any.
  void report_drops();

 private:
  void take(const Subscribe& message);
  void take(const Unsubscribe& message);
  void take(const Advertise& message);
  void take(const Unadvertise& message);
  void take(const GetParameters& message);
  void take(const SetParameters& message);
  void take(const WatchParameters& message);
  void take(const WatchGraph& message);
  void take(const Publish& message);
  void take(const ServiceCall& message);
  void subscribe(const Subscribe::Subscription& wanted);
  void advertise(const Advertise::Channel& offered);
  bool admit_watcher();
  bool admit_question();
  void complain(const std::string& sentence);

  ClientId id_;
  const Catalogue& catalogue_;
  Watchers& watchers_;
  RequestSink sink_;
  ClientQueue queue_;
  std::map<std::uint32_t, std::uint32_t> channel_of_, subscription_of_;  // by subscription, by channel
  std::map<std::uint32_t, std::uint32_t> inlet_of_;  // by the client's number of a channel
  std::set<std::string, std::less<>> watched_;       // parameters
  bool watches_all_ = false;
  std::optional<ConnectionGraph> graph_sent_;
  int questions_ = 0;  // that the robot has not answered yet
  std::uint64_t drops_reported_ = 0;
};

}  // namespace astro::foxglove
