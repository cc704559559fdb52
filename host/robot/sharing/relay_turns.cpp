#include <algorithm>
#include <array>

#include "common/protocol/messages.hpp"
#include "host/robot/sharing/relay.hpp"

/// Which program may ask the robot next.
namespace astro::robot {

using namespace protocol;  // NOLINT(google-build-using-namespace): this file is all messages
using std::chrono::milliseconds;

namespace {

constexpr microseconds kRepeat = milliseconds(60);
// After this time the program itself has given up: a Client tries for one second, and for four at a commit.
constexpr microseconds kTurn = milliseconds(1000);
constexpr microseconds kCommitTurn = milliseconds(4500);

}  // namespace

void Relay::wait_for_turn(RelaySession& session) {
  if (std::find(waiting_.begin(), waiting_.end(), session.id) == waiting_.end())
    waiting_.push_back(session.id);
}

void Relay::next_onlooker(microseconds now) {
  if (under_way_ && now >= give_up_at_) under_way_.reset();
  while (!under_way_ && !waiting_.empty()) {
    RelaySession* session = find(waiting_.front());
    waiting_.pop_front();
    if (session == nullptr || !session->current || session->current->state == Exchange::State::sent) continue;
    const std::uint8_t message = session->current->header.message_id;
    if (!staging_allows(*session, message)) continue;
    under_way_ = session->id;
    give_up_at_ = now + (message == CommitParameters::kId ? kCommitTurn : kTurn);
    send(*session, *session->current, now);
  }
}

/// Sends the relay's own request, as an onlooker's, and repeats it until the robot acknowledges it.
void Relay::ask_for_telemetry(microseconds now) {
  RelaySession& self = sessions_.front();
  if (telemetry_changed_) {
    telemetry_changed_ = false;
    stream_ = {};
    for (const RelaySession& session : sessions_)
      stream_ = TelemetryRequest::merge(stream_, session.telemetry);
    own_requests_ = static_cast<std::uint16_t>(own_requests_ == 0xFFFF ? 1 : own_requests_ + 1);
    std::array<std::uint8_t, kMaxBody> body;  // NOLINT(cppcoreguidelines-pro-type-member-init)
    const std::size_t size = encode(stream_, own_requests_, body);
    begin(self, Exchange({SetTelemetry::kId, own_requests_}, std::span(body).first(size)), now);
  } else if (self.current && self.current->state == Exchange::State::sent &&
             now >= self.current->sent_at + kRepeat) {
    repeat(self, now);
  }
}

void Relay::tick(microseconds now) {
  ask_for_telemetry(now);
  next_onlooker(now);
}

std::optional<microseconds> Relay::next_tick() const {
  std::optional<microseconds> next;
  if (under_way_ && !waiting_.empty()) next = give_up_at_;
  const auto& own = sessions_.front().current;
  if (own && own->state == Exchange::State::sent)
    next = std::min(next.value_or(microseconds::max()), own->sent_at + kRepeat);
  return next;
}

}  // namespace astro::robot
