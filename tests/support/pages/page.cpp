#include "tests/support/pages/page.hpp"

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core/buffers_to_string.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/websocket/stream.hpp>
#include <stdexcept>

namespace astro::support {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace websocket = beast::websocket;
using asio::ip::tcp;
using nlohmann::json;

namespace {

constexpr std::chrono::seconds kLong{100};  // a machine that is busy with something else

}  // namespace

std::string answer_of_server(std::uint16_t port, const std::string& bytes) {
  asio::io_context io;
  tcp::socket socket(io);
  socket.connect({asio::ip::address_v4::loopback(), port});
  beast::error_code error;
  asio::write(socket, asio::buffer(bytes), error);
  std::string answer;
  asio::read(socket, asio::dynamic_buffer(answer), error);  // ends with an error: that it is closed
  return answer;
}

std::string request(const std::string& line, std::uint16_t port, const std::string& fields,
                    const std::string& body) {
  std::string text = line + " HTTP/1.1\r\n";
  if (fields.find("Host:") == std::string::npos) text += "Host: 127.0.0.1:" + std::to_string(port) + "\r\n";
  if (!body.empty()) text += "Content-Length: " + std::to_string(body.size()) + "\r\n";
  return text + fields + "\r\n" + body;
}

struct OpenPage::State {
  asio::io_context io;
  websocket::stream<tcp::socket> stream{io};
  beast::flat_buffer buffer;
  bool reading = false, read = false, ended = false;
};

OpenPage::OpenPage(std::uint16_t port, const std::string& token, const Handshake& handshake)
    : state_(std::make_unique<State>()) {
  state_->stream.next_layer().connect({asio::ip::address_v4::loopback(), port});
  state_->stream.set_option(websocket::stream_base::decorator([&](websocket::request_type& header) {
    if (!handshake.origin.empty()) header.set(beast::http::field::origin, handshake.origin);
  }));
  const std::string host = handshake.host.empty() ? "127.0.0.1:" + std::to_string(port) : handshake.host;
  state_->stream.handshake(host, "/calls");
  state_->stream.read_message_max(64 << 20);
  if (token.empty()) return;
  say(json{{"token", token}}.dump());
  const json told = answer_to(0);
  if (told.contains("result")) number_ = told["result"]["page"];
}
OpenPage::~OpenPage() = default;
OpenPage::OpenPage(OpenPage&&) noexcept = default;

void OpenPage::say(const std::string& text) {
  state_->stream.text(true);
  beast::error_code error;  // that it is closed, which the next read shows
  state_->stream.write(asio::buffer(text), error);
}

bool OpenPage::read_message(std::chrono::steady_clock::time_point end) {
  State& state = *state_;
  if (state.ended) return false;
  if (!state.reading) {
    state.reading = true;
    state.read = false;
    state.buffer.clear();
    state.stream.async_read(state.buffer, [&state](beast::error_code error, std::size_t) {
      state.reading = false;
      state.read = !error;
      state.ended = static_cast<bool>(error);
    });
  }
  state.io.restart();
  while (state.reading && std::chrono::steady_clock::now() < end) state.io.run_one_until(end);
  if (state.reading || !state.read) return false;
  const json message = json::parse(beast::buffers_to_string(state.buffer.data()));
  if (message.contains("event"))
    events_.push_back(message["event"]);
  else
    answers_.push_back(message);
  return true;
}

std::int64_t OpenPage::begin(const std::string& call, const json& question) {
  say(json{{"id", ++last_id_}, {"call", call}, {"question", question}}.dump());
  return last_id_;
}

json OpenPage::answer_to(std::int64_t id) {
  const auto end = std::chrono::steady_clock::now() + kLong;
  do {
    for (auto each = answers_.begin(); each != answers_.end(); ++each) {
      if (each->at("id") != id) continue;
      json answer = each->at("answer");
      answers_.erase(each);
      return answer;
    }
  } while (read_message(end));
  return {{"error", {{"sentence", "the connection has ended: " + why_it_ended()}}}};
}

json OpenPage::ask(const std::string& call, const json& question) { return answer_to(begin(call, question)); }

json OpenPage::result(const std::string& call, const json& question) {
  json answer = ask(call, question);
  if (!answer.contains("result")) throw std::runtime_error(call + ": " + answer.dump());
  return answer["result"];
}

bool OpenPage::hears(const std::function<bool(const json&)>& fits) {
  const auto end = std::chrono::steady_clock::now() + kLong;
  std::size_t looked_at = events_.size();
  do {
    for (; looked_at < events_.size(); ++looked_at)
      if (fits(events_[looked_at])) return true;
  } while (read_message(end));
  return false;
}

bool OpenPage::ends() {
  const auto end = std::chrono::steady_clock::now() + kLong;
  while (read_message(end)) {
  }
  return state_->ended;
}

std::string OpenPage::why_it_ended() const { return std::string(state_->stream.reason().reason.c_str()); }

}  // namespace astro::support
