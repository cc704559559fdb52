#include "tests/host/live/foxglove/viewer.hpp"

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/read_until.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/http/string_body.hpp>
#include <boost/beast/http/write.hpp>
#include <boost/beast/websocket/stream.hpp>

namespace astro::support {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using asio::ip::tcp;

HttpAnswer ask(std::uint16_t port, const ViewerRequest& request) {
  asio::io_context io;
  tcp::socket socket(io);
  socket.connect({asio::ip::address_v4::loopback(), port});
  http::request<http::empty_body> header(http::verb::get, "/", 11);
  header.set(http::field::host, "localhost");
  if (request.upgrade) {
    header.set(http::field::connection, "Upgrade");
    header.set(http::field::upgrade, "websocket");
    header.set(http::field::sec_websocket_version, "13");
    header.set(http::field::sec_websocket_key, "dGhlIHNhbXBsZSBub25jZQ==");  // of RFC 6455
  }
  if (!request.origin.empty()) header.set(http::field::origin, request.origin);
  if (!request.subprotocol.empty()) header.set(http::field::sec_websocket_protocol, request.subprotocol);
  http::write(socket, header);
  beast::flat_buffer buffer;
  http::response_parser<http::string_body> parser;
  http::read_header(socket, buffer, parser);
  return {static_cast<int>(parser.get().result_int()),
          std::string(parser.get()[http::field::sec_websocket_protocol])};
}

std::string answer_to(std::uint16_t port, const std::string& bytes) {
  asio::io_context io;
  tcp::socket socket(io);
  socket.connect({asio::ip::address_v4::loopback(), port});
  beast::error_code error;
  asio::write(socket, asio::buffer(bytes), error);
  std::string answer;
  asio::read(socket, asio::dynamic_buffer(answer), error);  // ends with an error: that it is closed
  return answer;
}

void flood(std::uint16_t port, const std::string& text, std::size_t times) {
  const std::string handshake =
      "GET / HTTP/1.1\r\nHost: robot\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
      "Sec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\r\nSec-WebSocket-Version: 13\r\n"
      "Sec-WebSocket-Protocol: foxglove.sdk.v1\r\n\r\n";
  asio::io_context io;
  tcp::socket socket(io);
  socket.connect({asio::ip::address_v4::loopback(), port});
  beast::error_code error;  // that it is closed
  asio::write(socket, asio::buffer(handshake), error);
  std::string answer;
  asio::read_until(socket, asio::dynamic_buffer(answer), "\r\n\r\n", error);
  std::string bytes;
  const std::string masked_with_zeros{'\x81', static_cast<char>(0x80 | text.size()), 0, 0, 0, 0};
  for (std::size_t i = 0; i < times; ++i) bytes += masked_with_zeros + text;
  asio::write(socket, asio::buffer(bytes), error);
}

struct Viewer::State {
  asio::io_context io;
  websocket::stream<tcp::socket> stream{io};
  beast::flat_buffer buffer;
  bool reading = false, read = false, ended = false;
};

Viewer::Viewer(std::uint16_t port, const ViewerRequest& request) : state_(std::make_unique<State>()) {
  tcp::socket& socket = state_->stream.next_layer();
  socket.open(tcp::v4());
  if (request.receive_buffer > 0)
    socket.set_option(asio::socket_base::receive_buffer_size(request.receive_buffer));
  socket.connect({asio::ip::address_v4::loopback(), port});
  state_->stream.set_option(websocket::stream_base::decorator([&](websocket::request_type& header) {
    if (!request.origin.empty()) header.set(beast::http::field::origin, request.origin);
    if (!request.subprotocol.empty())
      header.set(beast::http::field::sec_websocket_protocol, request.subprotocol);
  }));
  state_->stream.handshake("localhost:" + std::to_string(port), "/");
}
Viewer::~Viewer() = default;
Viewer::Viewer(Viewer&&) noexcept = default;

void Viewer::send(const std::string& text) {
  state_->stream.text(true);
  state_->stream.write(asio::buffer(text));
}

void Viewer::send(const Bytes& frame) {
  state_->stream.binary(true);
  state_->stream.write(asio::buffer(frame));
}

std::optional<Viewer::Message> Viewer::receive(std::chrono::milliseconds timeout) {
  State& state = *state_;
  if (state.ended) return std::nullopt;
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
  const auto end = std::chrono::steady_clock::now() + timeout;
  state.io.restart();
  while (state.reading && std::chrono::steady_clock::now() < end) state.io.run_one_until(end);
  if (state.reading || !state.read) return std::nullopt;
  const auto bytes = state.buffer.cdata();
  const auto* begin = static_cast<const std::uint8_t*>(bytes.data());
  return Message{state.stream.got_text(), Bytes(begin, begin + bytes.size())};
}

bool Viewer::ended() const { return state_->ended; }
std::string Viewer::why_it_ended() const { return std::string(state_->stream.reason().reason.c_str()); }

struct SilentConnection::State {
  asio::io_context io;
  tcp::socket socket{io};
};
SilentConnection::SilentConnection(std::uint16_t port) : state_(std::make_unique<State>()) {
  state_->socket.connect({asio::ip::address_v4::loopback(), port});
}
SilentConnection::~SilentConnection() = default;

}  // namespace astro::support
