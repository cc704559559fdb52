#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <utility>

#include "host/robot/sharing/exchange.hpp"
#include "host/robot/sharing/port_user.hpp"

namespace astro::robot {

/// One program at the port and its requests: the one under way, its pings, and the last answer.
class ProgramSession {
 public:
  ProgramSession(SessionId id, PortUser user) : id_(id), user_(std::move(user)) {}

  SessionId id() const { return id_; }
  const PortUser& user() const { return user_; }

  /// The request under way; null if there is none. A new one replaces it, because its program has given up
  /// the old one.
  Exchange* current() { return current_ ? &*current_ : nullptr; }
  const Exchange* current() const { return current_ ? &*current_ : nullptr; }
  Exchange& begin(Exchange request) { return current_.emplace(std::move(request)); }
  void end() { current_.reset(); }
  bool has_under_way(const protocol::Header& request) const {
    return current_ && current_->header == request;
  }

  /// The ping under way with this header: the one that the program repeats, or a new one. Pings change nothing
  /// and the robot does not remember them, so several may be under way; a new one overwrites the oldest.
  Exchange& ping(const protocol::Header& header, ByteView body);
  /// Ends the ping that this answers, and returns its header.
  std::optional<protocol::Header> take_pong(const protocol::Header& answer, microseconds now);

  /// The answer to the last request, as the robot remembers it for a port. A request that repeats it gets the
  /// same answer. Hello, Ping and the requests that halt the robot are not remembered: a stop must never be
  /// taken for an old one that had the same id before the program's ids wrapped.
  bool has_answered(const protocol::Header& request) const;
  const Bytes& answer() const { return answer_; }
  /// If `request` is the request under way, it ends.
  void remember_answer(const protocol::Header& request, const Bytes& frame);

  /// Drops the requests under way and the last answer.
  void forget();

 private:
  SessionId id_;
  PortUser user_;
  std::optional<Exchange> current_;
  std::array<Exchange, 4> pings_;
  std::size_t next_ping_ = 0;
  protocol::Header answered_;
  Bytes answer_;
};

}  // namespace astro::robot
