#pragma once

#include <boost/asio/io_context.hpp>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "host/base/error.hpp"
#include "host/robot/port/transport.hpp"

/// Transport over an Asio stream (posix::stream_descriptor, ip::tcp::socket). Internal to this room.
namespace astro::robot {

template <class Stream>
class StreamTransport final : public Transport {
 public:
  /// Opens the address; called for each opening. Throws Error if it cannot.
  using Opener = std::function<Stream(boost::asio::io_context&)>;

  /// Message clauses that depend on what is at the other end. The address is put before the values of `lost`.
  struct Sentences {
    std::function<Remark()> lost = [] { return Remark{"it was unplugged, switched off or ended"}; };
    std::function<Remark()> silent = [] { return Remark{}; };
  };

  StreamTransport(std::string name, Opener open) : StreamTransport(std::move(name), std::move(open), {}) {}
  StreamTransport(std::string name, Opener open, Sentences sentences);

  void write(std::span<const std::uint8_t> bytes) override;
  std::size_t read(std::span<std::uint8_t> into, microseconds timeout) override;
  microseconds now() const override;
  void reopen(microseconds timeout) override;
  Remark why_silent() override { return sentences_.silent(); }
  const std::string& name() const override { return name_; }

 private:
  template <class Wait>
  bool wait_for(Wait what, microseconds timeout);
  Stream opened();
  Stream& stream();
  [[noreturn]] void lose(const Remark& why);
  void pause(microseconds duration);

  std::string name_;
  Opener open_;
  Sentences sentences_;
  boost::asio::io_context context_;  // before stream_, so that it outlives it
  std::optional<Stream> stream_;     // empty once the other end is gone
  std::optional<microseconds> reopened_;
};

}  // namespace astro::robot
