#include "host/live/foxglove/connection.hpp"

#include <fmt/format.h>

#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/http/string_body.hpp>
#include <boost/beast/http/write.hpp>
#include <boost/beast/websocket/rfc6455.hpp>
#include <boost/beast/websocket/stream.hpp>
#include <boost/beast/websocket/teardown.hpp>
#include <chrono>
#include <optional>

#include "host/live/foxglove/batching_socket.hpp"
#include "host/live/foxglove/origin.hpp"

namespace astro::foxglove {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using beast::error_code;
using HttpRequest = http::request<http::empty_body>;

constexpr std::chrono::seconds kHandshakeTime{5}, kIdleTime{30};  // a ping goes out after half of the latter
constexpr std::size_t kMostHeader = 8 * 1024, kMostMessage = 1 << 20;
constexpr std::size_t kLongestOrigin = 200, kMostReported = 20;  // of origins that were refused
constexpr std::size_t kBatch =
    64 * 1024;  // with Beast and on its way; whatever else waits can still be dropped
constexpr int kSystemBuffer =
    256 * 1024;  // so that a slow client sees data of now, and not of some seconds ago

/// The newest subprotocol that both sides know; "" if there is none.
std::string subprotocol_of(const HttpRequest& request) {
  http::token_list offered(request[http::field::sec_websocket_protocol]);
  for (const char* ours : {"foxglove.sdk.v1", "foxglove.websocket.v1"})
    if (offered.exists(ours)) return ours;
  return "";
}

class WebSocketConnection : public Connection, public std::enable_shared_from_this<WebSocketConnection> {
 public:
  WebSocketConnection(asio::ip::tcp::socket socket, ConnectionRules& rules)
      : peer_(name_of(socket)),
        rules_(rules),
        deadline_(socket.get_executor()),
        stream_(configured(std::move(socket))) {}
  ~WebSocketConnection() override { end(); }

  void start() override {
    deadline_.expires_after(kHandshakeTime);
    deadline_.async_wait([self = weak_from_this()](error_code error) {
      if (const auto alive = self.lock(); alive && !error) alive->cut();
    });
    parser_.emplace();
    parser_->header_limit(kMostHeader);
    parser_->body_limit(0);
    http::async_read(stream_.next_layer(), buffer_, *parser_,
                     [self = shared_from_this()](error_code error, std::size_t) { self->decide(error); });
  }

  void send_waiting() override {
    if (session_ == nullptr) return;
    if (session_->queue().overflowed()) return cut();
    error_code error;
    while (stream_.next_layer().waiting() < kBatch && !error) {
      const std::optional<Frame> frame = session_->queue().pop();
      if (!frame) break;
      stream_.text(frame->is_text);
      const ByteView payload = frame->sample ? ByteView(frame->sample->payload) : ByteView();
      stream_.write(std::array{asio::buffer(frame->head), asio::buffer(payload.data(), payload.size())},
                    error);
    }
    if (session_->queue().empty())
      stuck_since_.reset();
    else if (!stuck_since_)
      stuck_since_ = Clock::now();
    stream_.next_layer().flush();
  }

  void close() override {
    if (session_ == nullptr) return cut();
    send_waiting();
    stream_.async_close(websocket::close_code::going_away, [self = shared_from_this()](error_code) {});
  }

  bool ended() const override { return ended_; }

  bool watches() const override { return session_ != nullptr && session_->watches(); }
  Clock::time_point heard_at() const override { return heard_at_; }
  std::optional<Clock::time_point> stuck_since() const override { return stuck_since_; }

  void dismiss(const Remark& why) override {
    if (session_ != nullptr)
      rules_.notice(
          {fmt::format("the viewer at {} was disconnected: {}", peer_, why.sentence), why.kind, {peer_}});
    if (session_ == nullptr || stuck_since_) return cut();
    heard_at_ = Clock::now();  // so that others count as idler until it has gone
    stream_.async_close({websocket::close_code::try_again_later, why.sentence},
                        [self = shared_from_this()](error_code) {});
    stream_.next_layer().finish();
  }

 private:
  static std::string name_of(const asio::ip::tcp::socket& socket) {
    error_code error;
    const auto peer = socket.remote_endpoint(error);
    return error ? "somebody" : fmt::format("{}:{}", peer.address().to_string(), peer.port());
  }

  static asio::ip::tcp::socket configured(asio::ip::tcp::socket socket) {
    error_code ignored;
    socket.set_option(asio::ip::tcp::no_delay(true), ignored);
    socket.set_option(asio::socket_base::send_buffer_size(kSystemBuffer), ignored);
    return socket;
  }

  void decide(error_code error) {
    if (error) return end();
    const HttpRequest& request = parser_->get();
    if (const std::string origin(request[http::field::origin]); !origin_is_allowed(origin, rules_.origins)) {
      report_refusal(origin.substr(0, kLongestOrigin));
      return refuse(http::status::forbidden, "this page may not look at the robot");
    }
    if (!websocket::is_upgrade(request))
      return refuse(http::status::upgrade_required, "this is a WebSocket for Foxglove");
    if (subprotocol_of(request).empty())
      return refuse(http::status::bad_request,
                    "the subprotocol is neither foxglove.sdk.v1 nor foxglove.websocket.v1");
    accept(request);
  }

  void report_refusal(const std::string& origin) {
    if (rules_.refused.size() >= kMostReported || !rules_.refused.insert(origin).second) return;
    if (origin_can_be_proposed(origin))
      rules_.notice({fmt::format("a page of '{}' was refused", origin), OriginProblem::refused, {origin}});
    else
      rules_.notice({"a page was refused whose origin no browser gives to a web site", {}});
  }

  void refuse(http::status status, const char* why) {
    auto response = std::make_shared<http::response<http::string_body>>(status, 11, fmt::format("{}\n", why));
    response->set(http::field::content_type, "text/plain");
    response->set(http::field::connection, "close");
    if (status == http::status::upgrade_required) response->set(http::field::upgrade, "websocket");
    response->prepare_payload();
    http::async_write(stream_.next_layer(), *response,
                      [self = shared_from_this(), response](error_code, std::size_t) {
                        self->stream_.next_layer().finish();
                        self->end();
                      });
  }

  void accept(const HttpRequest& request) {
    auto timeouts = websocket::stream_base::timeout::suggested(beast::role_type::server);
    timeouts.idle_timeout = kIdleTime;
    timeouts.keep_alive_pings = true;
    stream_.set_option(timeouts);
    stream_.set_option(websocket::stream_base::decorator(
        [subprotocol = subprotocol_of(request)](websocket::response_type& response) {
          response.set(http::field::sec_websocket_protocol, subprotocol);
        }));
    stream_.read_message_max(kMostMessage);
    stream_.auto_fragment(false);
    stream_.async_accept(request, [self = shared_from_this()](error_code error) {
      if (error) return self->end();
      self->welcome();
    });
  }

  void welcome() {
    deadline_.cancel();
    parser_.reset();
    buffer_.clear();
    session_ = &rules_.hub->join();
    stream_.next_layer().on_sent([self = weak_from_this()] {
      const auto alive = self.lock();
      if (!alive) return;
      alive->stuck_since_.reset();
      alive->send_waiting();
    });
    rules_.notice({fmt::format("a viewer has connected from {}", peer_)});
    send_waiting();
    if (!ended_) read();
  }

  void read() {
    stream_.async_read(buffer_, [self = shared_from_this()](error_code error, std::size_t) {
      // What was received before the client was cut counts no more.
      if (error || self->ended_) return self->end();
      self->heard_at_ = Clock::now();
      const auto bytes = self->buffer_.cdata();
      self->session_->receive(self->stream_.got_text(),
                              {static_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
      self->buffer_.clear();
      self->send_waiting();
      if (!self->ended_) self->read();
    });
  }

  /// Ends the connection without a message, because the other side does not read, or has sent no request.
  void cut() {
    error_code ignored;
    stream_.next_layer().next_layer().close(ignored);
    end();
  }

  void end() {
    if (std::exchange(ended_, true)) return;
    deadline_.cancel();
    if (session_ == nullptr) return;
    rules_.hub->leave(session_->id());
    session_ = nullptr;
    try {
      rules_.notice({fmt::format("the viewer at {} has gone", peer_)});
    } catch (const std::exception&) {  // the destructor calls end(), too
    }
  }

  std::string peer_;
  ConnectionRules& rules_;
  asio::steady_timer deadline_;  // of the handshake
  websocket::stream<BatchingSocket, false> stream_;
  beast::flat_buffer buffer_;
  std::optional<http::request_parser<http::empty_body>> parser_;
  Session* session_ = nullptr;  // once it is a client
  Clock::time_point heard_at_ = Clock::now();
  std::optional<Clock::time_point> stuck_since_;
  bool ended_ = false;
};

}  // namespace

std::shared_ptr<Connection> make_connection(asio::ip::tcp::socket socket, ConnectionRules& rules) {
  return std::make_shared<WebSocketConnection>(std::move(socket), rules);
}

}  // namespace astro::foxglove
