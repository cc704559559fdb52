#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace astro::support {

/// Says these bytes to a server of this computer; its answer, until it ends the connection.
std::string answer_of_server(std::uint16_t port, const std::string& bytes);

/// "GET /x HTTP/1.1" with these lines, of a browser that names the server by its address.
std::string request(const std::string& line, std::uint16_t port, const std::string& fields = "",
                    const std::string& body = "");

/// What a browser says in the handshake of a WebSocket; "" leaves a field out.
struct Handshake {
  std::string host{};    // "": by address
  std::string origin{};  // "": a program that is no browser
};

/// A page that somebody has open, at the other end of the calls' WebSocket.
class OpenPage {
 public:
  /// Throws if the handshake is refused. `token`: said first, unless it is "".
  OpenPage(std::uint16_t port, const std::string& token, const Handshake& handshake = {});
  /// The page is closed, as by a reload or a crash: nothing is said any more.
  ~OpenPage();
  OpenPage(OpenPage&&) noexcept;

  void say(const std::string& text);
  /// Asks, and waits for the answer; events that come meanwhile are kept.
  nlohmann::json ask(const std::string& call, const nlohmann::json& question = nlohmann::json::object());
  /// The same; throws if it is refused.
  nlohmann::json result(const std::string& call, const nlohmann::json& question = nlohmann::json::object());
  /// Asks without waiting; the number of the question.
  std::int64_t begin(const std::string& call, const nlohmann::json& question);
  nlohmann::json answer_to(std::int64_t id);

  /// Reads until an event fits; false after a long time, or once the connection has ended.
  bool hears(const std::function<bool(const nlohmann::json& event)>& fits);
  /// Reads until the other side has ended the connection; false after a long time.
  bool ends();
  std::string why_it_ended() const;

  int number() const { return number_; }
  /// All events so far.
  const std::vector<nlohmann::json>& events() const { return events_; }

 private:
  struct State;
  bool read_message(std::chrono::steady_clock::time_point end);

  std::unique_ptr<State> state_;
  std::int64_t last_id_ = 0;
  int number_ = 0;
  std::vector<nlohmann::json> events_;
  std::vector<nlohmann::json> answers_;  // {"id", "answer"}
};

}  // namespace astro::support
