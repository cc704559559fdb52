#include "host/robot/port/stream_transport.hpp"

#include <boost/asio/buffer.hpp>
#include <boost/asio/error.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/local/stream_protocol.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <boost/system/system_error.hpp>
#include <thread>

#include "host/base/system_error.hpp"

namespace astro::robot {

namespace asio = boost::asio;
using boost::system::error_code;
using std::chrono::milliseconds;

namespace {
constexpr microseconds kWriteTimeout = milliseconds(1000);
constexpr microseconds kReopenPause = milliseconds(50);
}  // namespace

template <class Stream>
StreamTransport<Stream>::StreamTransport(std::string name, Opener open, Sentences sentences)
    : name_(std::move(name)), open_(std::move(open)), sentences_(std::move(sentences)), stream_(opened()) {}

template <class Stream>
microseconds StreamTransport<Stream>::now() const {
  return std::chrono::duration_cast<microseconds>(std::chrono::steady_clock::now().time_since_epoch());
}

/// Asio has descriptors of its own, and throws its own exception if it gets none.
template <class Stream>
Stream StreamTransport<Stream>::opened() {
  try {
    return open_(context_);
  } catch (const boost::system::system_error& error) {
    throw system_error("no connection to " + name_ + " can be made", error.code().value());
  }
}

template <class Stream>
Stream& StreamTransport<Stream>::stream() {
  if (!stream_) throw LinkLost("lost " + name_ + ": it has to be opened again");
  return *stream_;
}

template <class Stream>
void StreamTransport<Stream>::lose(const Remark& why) {
  stream_.reset();
  Remark lost = why.in("lost " + name_ + ": ");
  lost.values.insert(lost.values.begin(), name_);
  throw LinkLost(lost);
}

template <class Stream>
template <class Wait>
bool StreamTransport<Stream>::wait_for(Wait what, microseconds timeout) {
  bool ready = false;
  stream().async_wait(what, [&](const error_code& error) { ready = !error; });
  context_.restart();
  context_.run_for(timeout);
  if (!ready) {
    stream().cancel();
    context_.restart();
    context_.run();
  }
  return ready;
}

template <class Stream>
void StreamTransport<Stream>::write(std::span<const std::uint8_t> bytes) {
  while (!bytes.empty()) {
    error_code error;
    const std::size_t written = stream().write_some(asio::buffer(bytes.data(), bytes.size()), error);
    bytes = bytes.subspan(written);
    if (error == asio::error::would_block) {
      if (!wait_for(Stream::wait_write, kWriteTimeout)) lose({"it takes no more bytes"});
    } else if (error) {
      lose(sentences_.lost());
    }
  }
}

template <class Stream>
std::size_t StreamTransport<Stream>::read(std::span<std::uint8_t> into, microseconds timeout) {
  for (bool waited = timeout <= microseconds::zero();; waited = true) {
    error_code error;
    const std::size_t size = stream().read_some(asio::buffer(into.data(), into.size()), error);
    if (!error) return size;
    if (error != asio::error::would_block) lose(sentences_.lost());
    if (waited || !wait_for(Stream::wait_read, timeout)) return 0;
  }
}

template <class Stream>
void StreamTransport<Stream>::pause(microseconds duration) {
  if (duration > microseconds::zero()) std::this_thread::sleep_for(duration);
}

template <class Stream>
void StreamTransport<Stream>::reopen(microseconds timeout) {
  const microseconds deadline = now() + timeout;
  stream_.reset();
  // A device that appears and disappears again at once must not cause a busy loop.
  if (reopened_) pause(std::min(*reopened_ + kReopenPause - now(), timeout));
  while (true) {
    try {
      stream_.emplace(opened());
      reopened_ = now();
      return;
    } catch (const Error&) {
      if (now() >= deadline) throw;
    }
    pause(std::min(kReopenPause, deadline - now()));
  }
}

template class StreamTransport<asio::ip::tcp::socket>;
template class StreamTransport<asio::local::stream_protocol::socket>;
template class StreamTransport<asio::posix::stream_descriptor>;

}  // namespace astro::robot
