#include "host/live/web/connection.hpp"

#include <fmt/format.h>

#include <array>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/file_body.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/http/string_body.hpp>
#include <boost/beast/http/write.hpp>
#include <boost/beast/websocket/rfc6455.hpp>
#include <boost/beast/websocket/stream.hpp>
#include <boost/beast/websocket/teardown.hpp>
#include <chrono>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "host/live/web/batching_socket.hpp"

namespace astro::web {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using beast::error_code;
using HttpRequest = http::request<http::empty_body>;

constexpr std::chrono::seconds kHandshakeTime{5};
constexpr std::chrono::minutes kBodyTime{10};
constexpr std::size_t kBatch =
    64 * 1024;  // with Beast and on its way; whatever else waits can still be dropped
constexpr int kSystemBuffer =
    256 * 1024;  // so that a slow client sees data of now, and not of some seconds ago

std::string text_of(beast::string_view text) { return {text.data(), text.size()}; }

RequestHead head_of(const HttpRequest& request) {
  RequestHead head{
      text_of(request.method_string()), text_of(request.target()), {}, websocket::is_upgrade(request)};
  for (const auto& field : request)
    head.fields.emplace_back(text_of(field.name_string()), text_of(field.value()));
  return head;
}

class HttpConnection : public Connection, public std::enable_shared_from_this<HttpConnection> {
 public:
  HttpConnection(asio::ip::tcp::socket socket, Site& site)
      : peer_(name_of(socket)),
        site_(site),
        limits_(site.limits()),
        deadline_(socket.get_executor()),
        stream_(configured(std::move(socket))) {}
  ~HttpConnection() override { end(); }

  void start() override {
    allow(kHandshakeTime);
    parser_.emplace();
    parser_->header_limit(static_cast<std::uint32_t>(limits_.header_bytes));
    // The site decides by the header, and an upload has its own limit: what is too much gets an answer that says so. No number
    // means no limit, but Boost 1.74 takes it for zero.
    parser_->body_limit(std::numeric_limits<std::uint64_t>::max());
    http::async_read_header(
        stream_.next_layer(), buffer_, *parser_,
        [self = shared_from_this()](error_code error, std::size_t) { self->decide(error); });
  }

  void send_waiting() override {
    if (client_ == nullptr) return;
    if (client_->queue().overflowed()) return cut();
    error_code error;
    while (stream_.next_layer().waiting() < kBatch && !error) {
      const std::optional<Frame> frame = client_->queue().pop();
      if (!frame) break;
      stream_.text(frame->is_text);
      const ByteView payload = frame->sample ? ByteView(frame->sample->payload) : ByteView();
      stream_.write(std::array{asio::buffer(frame->head), asio::buffer(payload.data(), payload.size())},
                    error);
    }
    if (client_->queue().empty())
      stuck_since_.reset();
    else if (!stuck_since_)
      stuck_since_ = Clock::now();
    stream_.next_layer().flush();
  }

  void close() override {
    if (client_ == nullptr) return cut();
    send_waiting();
    begin_close(websocket::close_code::going_away);
  }

  bool ended() const override { return ended_; }

  bool watches() const override { return client_ != nullptr && client_->watches(); }
  Clock::time_point heard_at() const override { return heard_at_; }
  std::optional<Clock::time_point> stuck_since() const override { return stuck_since_; }

  void dismiss(const Remark& why) override {
    if (client_ != nullptr) client_->dismissed(why);
    if (client_ == nullptr || stuck_since_) return cut();
    heard_at_ = Clock::now();  // so that others count as idler until it has gone
    say_goodbye(websocket::close_code::try_again_later, why.sentence);
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

  /// Ends the connection if what is under way takes longer.
  void allow(std::chrono::steady_clock::duration time) {
    deadline_.expires_after(time);
    deadline_.async_wait([self = weak_from_this()](error_code error) {
      if (const auto alive = self.lock(); alive && !error) alive->cut();
    });
  }

  void decide(error_code error) {
    if (error) return end();
    Decision decision = site_.decide(head_of(parser_->get()));
    std::visit([this](auto& each) { carry_out(std::move(each)); }, decision);
  }

  void carry_out(Response&& response) {
    if (response.file.empty()) {
      auto message = std::make_shared<http::response<http::string_body>>(
          static_cast<http::status>(response.status), 11, std::move(response.body));
      return send(std::move(message), response.fields);
    }
    auto message =
        std::make_shared<http::response<http::file_body>>(static_cast<http::status>(response.status), 11);
    error_code error;
    message->body().open(response.file.c_str(), beast::file_mode::scan, error);
    if (error) return carry_out(sentence_response(404, "there is no such file"));
    send(std::move(message), response.fields);
  }

  template <class Body>
  void send(std::shared_ptr<http::response<Body>> message, const Fields& fields) {
    for (const auto& [name, value] : fields) message->set(name, value);
    message->set(http::field::connection, "close");
    message->prepare_payload();
    allow(kBodyTime);
    // A serializer of its own: a file is read while it is sent.
    auto serializer = std::make_shared<http::response_serializer<Body>>(*message);
    // Past the BatchingSocket, which takes all that is written at once.
    http::async_write(stream_.next_layer().next_layer(), *serializer,
                      [self = shared_from_this(), message, serializer](error_code, std::size_t) {
                        self->stream_.next_layer().finish();
                        self->end();
                      });
  }

  void carry_out(Upload&& upload) {
    auto parser = std::make_shared<http::request_parser<http::file_body>>(std::move(*parser_));
    parser->body_limit(upload.most_bytes);
    error_code error;
    parser->get().body().open(upload.into.c_str(), beast::file_mode::write, error);
    if (error) return carry_out(sentence_response(500, "the file cannot be written"));
    allow(kBodyTime);
    http::async_read(
        stream_.next_layer(), buffer_, *parser,
        [self = shared_from_this(), parser, upload = std::move(upload)](error_code failure, std::size_t) {
          parser->get().body().close();
          if (!failure) return self->carry_out(upload.done());
          upload.failed();
          self->end();
        });
  }

  void carry_out(Upgrade&& upgrade) {
    auto timeouts = websocket::stream_base::timeout::suggested(beast::role_type::server);
    timeouts.idle_timeout = std::chrono::seconds(limits_.idle_s);
    timeouts.keep_alive_pings = true;
    stream_.set_option(timeouts);
    if (!upgrade.subprotocol.empty())
      stream_.set_option(websocket::stream_base::decorator(
          [subprotocol = upgrade.subprotocol](websocket::response_type& response) {
            response.set(http::field::sec_websocket_protocol, subprotocol);
          }));
    stream_.read_message_max(limits_.message_bytes);
    stream_.auto_fragment(false);
    stream_.async_accept(parser_->get(),
                         [self = shared_from_this(), join = std::move(upgrade.join)](error_code error) {
                           if (error) return self->end();
                           self->welcome(join);
                         });
  }

  void welcome(const std::function<std::unique_ptr<Client>(const std::string&)>& join) {
    parser_.reset();
    buffer_.clear();
    client_ = join(peer_);
    if (client_->is_admitted()) deadline_.cancel();
    stream_.next_layer().on_sent([self = weak_from_this()] {
      const auto alive = self.lock();
      if (!alive) return;
      alive->stuck_since_.reset();
      alive->send_waiting();
    });
    client_->welcomed();
    send_waiting();
    if (!ended_) read();
  }

  void read() {
    stream_.async_read(buffer_, [self = shared_from_this()](error_code error, std::size_t) {
      // What was received before the client was cut counts no more.
      if (error || self->ended_) return self->end();
      self->heard_at_ = Clock::now();
      const auto bytes = self->buffer_.cdata();
      self->client_->receive(self->stream_.got_text(),
                             {static_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
      self->buffer_.clear();
      self->send_waiting();
      if (!self->ended_) self->go_on();
    });
  }

  void go_on() {
    if (const std::string why = client_->why_refused(); !why.empty())
      return say_goodbye(websocket::close_code::policy_error, why);
    if (client_->is_admitted()) deadline_.cancel();
    read();
  }

  void say_goodbye(websocket::close_code code, const std::string& why) {
    begin_close({code, why});
    stream_.next_layer().finish();
  }

  /// A stream may be closed once only, and the server can end while a client that was refused is still being told why.
  void begin_close(const websocket::close_reason& reason) {
    if (std::exchange(closing_, true)) return;
    stream_.async_close(reason, [self = shared_from_this()](error_code) {});
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
    client_.reset();
  }

  std::string peer_;
  Site& site_;
  Limits limits_;
  asio::steady_timer deadline_;  // of the handshake
  websocket::stream<BatchingSocket, false> stream_;
  beast::flat_buffer buffer_;
  std::optional<http::request_parser<http::empty_body>> parser_;
  std::unique_ptr<Client> client_;  // once it is one
  Clock::time_point heard_at_ = Clock::now();
  std::optional<Clock::time_point> stuck_since_;
  bool closing_ = false, ended_ = false;
};

}  // namespace

std::shared_ptr<Connection> make_connection(asio::ip::tcp::socket socket, Site& site) {
  return std::make_shared<HttpConnection>(std::move(socket), site);
}

}  // namespace astro::web
