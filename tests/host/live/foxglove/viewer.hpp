#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "host/base/bytes.hpp"

namespace astro::support {

/// How a viewer asks for a connection; "" leaves a header out.
struct ViewerRequest {
  std::string origin{};
  std::string subprotocol = "foxglove.sdk.v1";
  int receive_buffer = 0;  // of the system, in bytes; 0: its default
  bool upgrade = true;     // for a WebSocket
};

struct HttpAnswer {
  int status = 0;
  std::string subprotocol{};
};

/// Asks for a connection, and closes it at once.
HttpAnswer ask(std::uint16_t port, const ViewerRequest& request);

/// What comes after these bytes, until the other side ends the connection.
std::string answer_to(std::uint16_t port, const std::string& bytes);

/// Shakes hands, says `text` (at most 125 characters) so many times in large pieces and reads nothing; returns when all is said or
/// the other side has ended the connection.
void flood(std::uint16_t port, const std::string& text, std::size_t times);

/// A connection on which nothing is said, until it is destroyed.
class SilentConnection {
 public:
  explicit SilentConnection(std::uint16_t port);
  ~SilentConnection();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// A WebSocket client in tests, on Beast's client side. It reads only when it is asked.
class Viewer {
 public:
  /// Throws if it is refused.
  explicit Viewer(std::uint16_t port, const ViewerRequest& request = {});
  ~Viewer();
  Viewer(Viewer&&) noexcept;

  void send(const std::string& text);
  void send(const Bytes& frame);

  struct Message {
    bool is_text = false;
    Bytes bytes;
  };
  /// The next message, if it comes within `timeout`.
  std::optional<Message> receive(std::chrono::milliseconds timeout);
  /// The connection has ended, as the last receive() has seen.
  bool ended() const;
  /// What the other side said then.
  std::string why_it_ended() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace astro::support
