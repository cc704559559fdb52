#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "host/base/bytes.hpp"
#include "host/formats/messages/parameters.hpp"

/// What a viewer sends: JSON with an "op", and binary frames whose first byte says what they are.
///
/// Source  Foxglove WebSocket protocol, version 1; subprotocols foxglove.websocket.v1 and foxglove.sdk.v1.
namespace astro::foxglove {

/// What is wrong with a message of a viewer. Values: the member of the JSON that it is about; of
/// unknown_operation the first characters of the "op", of unknown_frame the number.
enum class MessageProblem {
  not_json,
  text_too_long,
  nested_too_deep,
  unknown_operation,
  missing,
  not_a_list,
  too_many_entries,
  not_32_bits,
  not_a_text,
  name_too_long,
  beyond_64_bits,
  no_parameter_value,
  frame_too_short,
  unknown_frame
};

struct Subscribe {
  struct Subscription {
    std::uint32_t id = 0;  // chosen by the client
    std::uint32_t channel = 0;
  };
  std::vector<Subscription> subscriptions;
};

struct Unsubscribe {
  std::vector<std::uint32_t> ids;
};

/// Topics that the client is going to publish.
struct Advertise {
  struct Channel {
    std::uint32_t id = 0;  // chosen by the client
    std::string topic, encoding, schema_name;
  };
  std::vector<Channel> channels;
};

struct Unadvertise {
  std::vector<std::uint32_t> ids;
};

/// No names: all parameters. The answer carries the same `id`.
struct GetParameters {
  std::vector<std::string> names;
  std::optional<std::string> id;
};

/// A whole number without "type": "float64" is an integer here, also if the parameter is a real number.
struct SetParameters {
  std::vector<ros2::msg::Parameter> parameters;
  std::optional<std::string> id;
};

/// Whether changes of these parameters are sent from now on. No names: of all.
struct WatchParameters {
  std::vector<std::string> names;
  bool on = false;
};

/// Whether changes of the connection graph are sent from now on.
struct WatchGraph {
  bool on = false;
};

/// A message on a channel that the client has advertised.
struct Publish {
  std::uint32_t channel = 0;
  ByteView data;
};

struct ServiceCall {
  std::uint32_t service = 0;
  std::uint32_t call = 0;  // chosen by the client; the answer carries it
  std::string_view encoding;
  ByteView data;
};

using ClientMessage = std::variant<Subscribe, Unsubscribe, Advertise, Unadvertise, GetParameters,
                                   SetParameters, WatchParameters, WatchGraph, Publish, ServiceCall>;

/// The longest text message, in bytes. A message that lists all parameters of a robot takes some 10 KiB.
inline constexpr std::size_t kLongestText = 256 * 1024;
/// The most entries of a list in a message: names of parameters, subscriptions, topics. A robot has some sixty parameters.
inline constexpr std::size_t kMostListed = 1000;

/// Throws astro::Error that says what is wrong, for anything that is not a message of the protocol: other JSON, an unknown
/// "op", missing or wrong fields, lists longer than kMostListed, names longer than ros2::kLongestName, values nested deeper
/// than the protocol's.
ClientMessage parse_text(std::string_view text);

/// Views into `frame`. Throws astro::Error for an unknown kind, and for a frame that is too short.
ClientMessage parse_binary(ByteView frame);

}  // namespace astro::foxglove
