#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "host/base/bytes.hpp"
#include "host/base/error.hpp"
#include "host/live/web/frame_queue.hpp"

/// What a server serves, without I/O: who is let in, and what is said to whom. All of it is called in the server's thread.
namespace astro::web {

using Fields = std::vector<std::pair<std::string, std::string>>;

/// A request without its body.
struct RequestHead {
  std::string method, target;  // "GET", "/files/a.csv?x"
  Fields fields;
  bool is_upgrade = false;  // to a WebSocket

  /// The first field of this name, in any case; "" if there is none.
  std::string_view field(std::string_view name) const;
  /// Whether a client offers this subprotocol for its WebSocket.
  bool offers(std::string_view subprotocol) const;
};

struct Response {
  int status = 200;
  Fields fields{};
  std::string body{};
  std::filesystem::path file{};  // instead of the body, unless it is empty
};

/// "text/plain", one sentence.
Response sentence_response(int status, std::string_view sentence);

/// The body of the request goes into a file.
struct Upload {
  std::filesystem::path into;
  std::uint64_t most_bytes = 0;
  std::function<Response()> done;  // it is whole
  std::function<void()> failed;    // it is not, and the file may be there
};

/// The other side of a WebSocket, until it has gone. Its destructor says so; it must not throw.
class Client {
 public:
  Client() = default;
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;
  virtual ~Client() = default;

  /// It has joined, and messages will come.
  virtual void welcomed() {}
  /// Takes one message, which may be any bytes.
  virtual void receive(bool is_text, ByteView message) = 0;
  /// What waits to be sent.
  virtual FrameQueue& queue() = 0;
  /// Whether it gets data. Of those that get none the one that has been silent the longest goes if there are too many.
  virtual bool watches() const = 0;
  /// Whether it has said what lets it stay. Until then it has the time of a handshake.
  virtual bool is_admitted() const { return true; }
  /// Why it must go, as a clause for it; "" if it may stay.
  virtual std::string why_refused() const { return ""; }
  /// It is disconnected for this reason.
  virtual void dismissed(const Remark&) {}
};

/// The request becomes a WebSocket.
struct Upgrade {
  std::string subprotocol;  // "": none
  /// `peer`: its address, for people.
  std::function<std::unique_ptr<Client>(const std::string& peer)> join;
};

using Decision = std::variant<Response, Upload, Upgrade>;

struct Limits {
  std::size_t header_bytes = 8 * 1024, message_bytes = 1 << 20;
  int idle_s = 30;  // who does not answer a ping within half of this is disconnected
};

class Site {
 public:
  virtual ~Site() = default;

  virtual Limits limits() const { return {}; }
  /// Whether to let in whoever asks this.
  virtual Decision decide(const RequestHead& request) = 0;
  /// Called four times a second.
  virtual void report() {}
  /// For the person who started the server.
  virtual void notice(const Remark& remark) = 0;
};

}  // namespace astro::web
