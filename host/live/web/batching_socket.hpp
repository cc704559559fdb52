#pragma once

#include <array>
#include <boost/asio/buffer.hpp>
#include <boost/asio/error.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core/bind_handler.hpp>
#include <boost/beast/core/role.hpp>
#include <functional>
#include <memory>

#include "host/base/bytes.hpp"

namespace astro::web {

/// A TCP socket, as a layer below Boost.Beast, that takes what is written at once and sends everything that has gathered with one
/// system call. A robot's telemetry is many small messages, of which each would otherwise cost a call and a wake-up.
///
/// Bounds   the owner writes only while waiting() is small. Beast itself answers pings; if more than kMost bytes wait, its
///          next write fails.
/// Threads  those of the socket's executor, which must run one handler at a time.
class BatchingSocket {
 public:
  using tcp = boost::asio::ip::tcp;
  using next_layer_type = tcp::socket;
  using executor_type = tcp::socket::executor_type;
  using error_code = boost::system::error_code;

  static constexpr std::size_t kMost = 1 << 20;  // bytes

  explicit BatchingSocket(tcp::socket socket) : state_(std::make_shared<State>(std::move(socket))) {}

  executor_type get_executor() { return state_->socket.get_executor(); }
  next_layer_type& next_layer() { return state_->socket; }
  const next_layer_type& next_layer() const { return state_->socket; }

  /// Called when a batch has gone out.
  void on_sent(std::function<void()> call) { state_->on_sent = std::move(call); }
  /// Bytes that the system has not taken yet.
  std::size_t waiting() const { return state_->gathering.size() + state_->sending.size(); }
  /// Sends what has gathered, unless a batch is on its way; then it follows.
  void flush() { send(state_); }
  /// Closes the connection once everything is sent.
  void finish() {
    state_->finishing = true;
    send(state_);
  }

  template <class Buffers, class Handler>
  auto async_read_some(const Buffers& buffers, Handler&& handler) {
    return state_->socket.async_read_some(buffers, std::forward<Handler>(handler));
  }
  /// Beast requires these two wherever it writes without a handler; nobody calls them.
  template <class Buffers>
  std::size_t read_some(const Buffers& buffers, error_code& error) {
    return state_->socket.read_some(buffers, error);
  }
  template <class Buffers>
  std::size_t read_some(const Buffers& buffers) {
    return state_->socket.read_some(buffers);
  }
  template <class Buffers>
  std::size_t write_some(const Buffers& buffers, error_code& error) {
    error = {};
    return gather(buffers);
  }
  template <class Buffers>
  std::size_t write_some(const Buffers& buffers) {
    return gather(buffers);
  }
  template <class Buffers, class Handler>
  auto async_write_some(const Buffers& buffers, Handler&& handler) {
    error_code error;
    std::size_t size = 0;
    if (waiting() > kMost)
      error = boost::asio::error::no_buffer_space;
    else
      size = gather(buffers);
    flush();
    return boost::asio::async_initiate<Handler, void(error_code, std::size_t)>(
        [executor = get_executor(), error, size](auto&& done) {
          boost::asio::post(
              executor, boost::beast::bind_front_handler(std::forward<decltype(done)>(done), error, size));
        },
        handler);
  }

 private:
  struct State {
    explicit State(tcp::socket opened) : socket(std::move(opened)) {}

    tcp::socket socket;
    Bytes gathering, sending;
    std::function<void()> on_sent;
    bool finishing = false;
  };

  template <class Buffers>
  std::size_t gather(const Buffers& buffers) {
    const std::size_t size = boost::asio::buffer_size(buffers), before = state_->gathering.size();
    state_->gathering.resize(before + size);
    return boost::asio::buffer_copy(boost::asio::buffer(state_->gathering) + before, buffers);
  }

  static void send(const std::shared_ptr<State>& state) {
    if (!state->sending.empty()) return;
    if (state->gathering.empty()) {
      error_code ignored;
      if (state->finishing) state->socket.shutdown(tcp::socket::shutdown_both, ignored);
      return;
    }
    state->sending.swap(state->gathering);
    boost::asio::async_write(state->socket, boost::asio::buffer(state->sending),
                             [state](error_code error, std::size_t) {
                               state->sending.clear();
                               if (error) return;  // the read that is under way ends with it, too
                               send(state);
                               if (state->on_sent) state->on_sent();
                             });
  }

  std::shared_ptr<State> state_;
};

/// Beast finds this function by its name, and calls it to end a WebSocket.
inline void teardown(boost::beast::role_type, BatchingSocket& socket, boost::system::error_code& error) {
  error = {};
  socket.finish();
}

template <class Handler>
void async_teardown(boost::beast::role_type, BatchingSocket& socket, Handler&& handler) {
  socket.finish();
  boost::asio::post(socket.get_executor(), boost::beast::bind_front_handler(std::forward<Handler>(handler),
                                                                            boost::system::error_code{}));
}

}  // namespace astro::web
