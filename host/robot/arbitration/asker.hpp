#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "host/robot/arbitration/exchange.hpp"
#include "host/robot/arbitration/port_users.hpp"

namespace astro::robot {

/// The requests of one program: the one under way, its pings, and the last answer.
class Asker {
 public:
  Asker(SessionId id, PortUser user) : id_(id), user_(std::move(user)) {}

  SessionId id() const { return id_; }
  const PortUser& user() const { return user_; }

  /// The request under way. A new one replaces it, because the program has given it up then.
  std::optional<Exchange> current;
  bool has_under_way(const protocol::Header& request) const { return current && current->header == request; }

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
  /// If it is the request under way, that has ended.
  void remember_answer(const protocol::Header& request, const Bytes& frame);

  /// Drops the requests under way and the last answer.
  void forget();

 private:
  SessionId id_;
  PortUser user_;
  std::array<Exchange, 4> pings_;
  std::size_t next_ping_ = 0;
  protocol::Header answered_;
  Bytes answer_;
};

}  // namespace astro::robot
