#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "host/base/bytes.hpp"
#include "host/formats/cdr/type_hash.hpp"
#include "host/live/driver/parameter_table.hpp"

/// Carries a node's topics, services and parameters to others: DDS (host/live/ros2), or the WebSocket of a viewer
/// (host/live/foxglove). Payloads are CDR with their encapsulation header. One thread uses all of it, and callbacks run in
/// that thread, inside poll().
namespace astro::live {

/// A message type as others have to know it. Valid as long as the program.
struct MessageType {
  std::string_view name;        // "nav_msgs/msg/Odometry"
  std::string_view definition;  // ros2msg: the .msg text, then those it refers to
  std::string_view hash;        // "RIHS01_..."
};

template <ros2::Message M>
MessageType message_type() {
  return {M::kType, ros2::definition_of<M>(), ros2::hash_of<M>()};
}

/// A topic and how its samples are kept. Names are absolute: "/odom".
struct TopicDescription {
  std::string name;
  MessageType type;
  bool reliable = true;
  bool latched = false;  // who subscribes later gets the last `depth` messages (transient local)
  int depth = 10;
};

struct ServiceDescription {
  std::string name;       // absolute: "/arm"
  std::string_view type;  // "std_srvs/srv/Trigger"
  MessageType request, response;
  bool urgent = false;                    // answered before all others that wait, whatever came first
  std::function<bool()> may_answer = {};  // calls wait until it returns true; empty: they never wait
};

class Publisher {
 public:
  Publisher() = default;
  Publisher(const Publisher&) = delete;
  Publisher& operator=(const Publisher&) = delete;
  virtual ~Publisher() = default;

  /// Never waits for a subscriber. `time_ns`: the time of the message's content, since 1970.
  virtual void publish(ByteView message, std::int64_t time_ns) = 0;
  /// Whether anybody would get a message, so that none is computed in vain.
  virtual bool has_subscribers() const = 0;
};

class Middleware {
 public:
  /// Called with each message of a topic. The message may be any bytes.
  using OnMessage = std::function<void(ByteView message)>;
  /// Returns the response; nothing if the bytes are not such a request. It may take as long as it needs.
  using OnRequest = std::function<std::optional<Bytes>(ByteView request)>;

  Middleware() = default;
  Middleware(const Middleware&) = delete;
  Middleware& operator=(const Middleware&) = delete;
  virtual ~Middleware() = default;

  /// The publisher must not outlive the middleware. Throws astro::Error if it is refused.
  virtual std::unique_ptr<Publisher> advertise(const TopicDescription& topic) = 0;
  /// The subscription lasts until the middleware ends. One name may be subscribed under several types.
  virtual void subscribe(const TopicDescription& topic, OnMessage on_message) = 0;
  /// Whether one topic name may have several types. In ROS 2 it should not: its tools neither record nor show such a topic.
  virtual bool types_may_share_a_name() const { return false; }
  virtual void serve(const ServiceDescription& service, OnRequest on_request) = 0;
  /// Lets others read and set parameters; `table` must outlive the middleware.
  virtual void serve_parameters(ParameterTable& table) = 0;

  /// Calls back for all that has come, and sends what is due. Never waits.
  virtual void poll() = 0;
  /// Answers only what is urgent, also from within a callback that takes long.
  virtual void poll_urgent() {}
  /// Returns when something has come for poll(), or at the latest after `timeout`.
  virtual void wait(std::chrono::microseconds timeout) = 0;
};

}  // namespace astro::live
