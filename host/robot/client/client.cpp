#include "host/robot/client/client.hpp"

#include <algorithm>
#include <utility>

#include "host/robot/client/handshake.hpp"
#include "host/robot/client/restore.hpp"
#include "host/robot/sharing/relay_messages.hpp"

namespace astro::robot {

using std::chrono::milliseconds;

namespace {

constexpr microseconds kKeepAlive = milliseconds(50);  // a quarter of the shortest time-out of a moving robot
constexpr microseconds kMapClock = milliseconds(200);
constexpr microseconds kPingTimeout = RetryPolicy().timeout;
constexpr int kLostPings = RetryPolicy().tries;
constexpr std::uint64_t kRestarted_us =
    1'000'000;  // a larger step back of the clock means a restart: frames are never that late
constexpr std::uint8_t kLastRequest = 0x3F;

}  // namespace

Client::Client(std::unique_ptr<Transport> transport) : owned_(std::move(transport)), transport_(*owned_) {}
Client::Client(Transport& transport) : transport_(transport) {}

const protocol::HelloReply& Client::connect(RetryPolicy policy) {
  forget();
  counts_ = {};
  echo_ = false;
  receiver_.drain(transport_);
  constexpr std::uint8_t kEndOfWhateverCameBefore = 0;
  transport_.write({&kEndOfWhateverCameBefore, 1});

  const std::uint16_t id = next_id();
  const Restore connecting(connecting_, true);
  const auto body = ask(protocol::Frame(protocol::Hello{}, id).bytes(), id, policy);
  if (!body)
    throw no_robot(name(), {transport_.why_silent(), echo_, receiver_.bytes(), receiver_.frames().good});
  if (body->front() == protocol::ErrorReply::kId) {
    const auto error = understand<protocol::ErrorReply>(*body, "Hello");
    if (error.code == protocol::ErrorCode::wrong_version) require_version(name(), error.detail);
    throw RobotRefused("Hello", error.code, error.detail);
  }
  robot_ = understand<protocol::HelloReply>(*body, "Hello");
  require_version(name(), robot_.protocol_version);
  return robot_;
}

void Client::reconnect(microseconds timeout) {
  const protocol::HelloReply known = robot_;
  const microseconds deadline = now() + timeout;
  // A failed try usually takes time. In virtual time a transport may fail without letting time pass; the
  // number of tries ends that case.
  for (auto tries = timeout / std::chrono::milliseconds(10); true; --tries) {
    try {
      transport_.reopen(std::max(deadline - now(), microseconds::zero()));
      connect();
      break;
    } catch (const Error& error) {
      if (now() >= deadline || tries <= 0) throw LinkLost(error.in("the link did not come back: "));
    }
  }
  const protocol::HelloReply answers = std::exchange(robot_, known);
  require_same_robot(name(), known, answers);
  robot_ = answers;
}

void Client::send(Body frame) {
  last_sent_ = now();
  transport_.write(frame);
}

std::optional<Client::Body> Client::ask(Body frame, std::uint16_t id, RetryPolicy policy) {
  const Restore waiting(waiting_for_, id);
  reply_.clear();
  for (int i = 0; i < policy.tries; ++i) {
    ++(i == 0 ? counts_.requests : counts_.repeats);
    send(frame);
    const microseconds deadline = now() + policy.timeout;
    do {
      step(deadline);
      if (!reply_.empty()) return reply_;
    } while (now() < deadline || receiver_.has_more());
  }
  return std::nullopt;
}

Client::Body Client::exchange(Body frame, std::uint16_t id, std::string_view request, RetryPolicy policy) {
  const auto body = ask(frame, id, policy);
  if (!body) {
    fail_silent("(" + std::string(request) + ", " + std::to_string(policy.tries) + " tries)");
  }
  if (body->front() != protocol::ErrorReply::kId) return *body;
  const auto error = understand<protocol::ErrorReply>(*body, request);
  throw RobotRefused(request, error.code, error.detail);
}

void Client::not_understood(std::string_view request) const {
  throw Error(
      "the answer of " + name() + " to " + std::string(request) +
      " cannot be understood although its check sum is right: firmware and this program differ; update both");
}

void Client::fail_silent(const std::string& when) {
  const Remark why = transport_.why_silent();
  const std::string silent = name() + " does not answer any more" + (when.empty() ? "" : " " + when);
  if (why.sentence.empty()) throw LinkLost(silent + ": is the robot still on and connected?");
  throw LinkLost(why.in(silent + ": "));
}

bool Client::step(microseconds deadline) {
  const auto body = receiver_.next(transport_, deadline);
  if (body) dispatch(*body);
  return body.has_value();
}

void Client::dispatch(Body body) {
  const protocol::Header header = *protocol::peek(body);  // a framer's body always has a header
  if (header.request_id == 0) return dispatch_event(body);
  if (header.message_id <= kLastRequest) {
    echo_ = true;
  } else if (header.request_id == waiting_for_ && reply_.empty()) {
    reply_.assign(body.begin(), body.end());
  } else if (ping_ && header.request_id == ping_->id) {
    take_pong(body);
  } else {
    ++counts_.stale_replies;
    if (header.message_id == protocol::Pong::kId) note_answer();  // late, but the robot is alive
  }
}

void Client::dispatch_event(Body body) {
  const auto deliver = [&]<class M>(Listeners<M>& listeners) {
    const auto event = protocol::decode<M>(body);
    if (!event.ok()) return;
    if constexpr (requires { event->device_time_us; }) note_device_time(event->device_time_us);
    if constexpr (M::kId == protocol::Booted::kId) forget();
    listeners.call(*event);
  };
  if (const auto missed = protocol::decode<protocol::EventsMissed>(body); missed.ok())
    counts_.missed_events += missed->count;
  if (const auto farewell = protocol::decode<Farewell>(body); farewell.ok())
    throw LinkLost("lost " + name() + ": " + std::string(fact(farewell->reason)), farewell->reason, {name()});
  std::apply([&](auto&... listeners) { (deliver(listeners), ...); }, listeners_);
  const bool booted = body.front() == protocol::Booted::kId;
  if (booted && waiting_for_ != 0 && !connecting_) {
    throw LinkLost("the robot at " + name() + " has restarted: what was under way is lost");
  }
}

void Client::take_pong(Body body) {
  const Sent ping = *ping_;
  ping_.reset();
  if (const auto pong = protocol::decode<protocol::Pong>(body); pong.ok()) {
    clock_.add({ping.at.count(), pong->device_time_us, now().count()});
    note_device_time(pong->device_time_us);
  }
  note_answer();
}

void Client::note_device_time(std::uint64_t device_us) {
  if (device_us + kRestarted_us < device_us_) forget();
  device_us_ = std::max(device_us_, device_us);
}

void Client::note_answer() {
  answered_device_us_ = device_us_;
  lost_pings_ = 0;
}

void Client::forget() {
  ping_.reset();
  last_ping_ = now();
  clock_.reset();
  device_us_ = answered_device_us_ = 0;
  lost_pings_ = 0;
}

microseconds Client::next_ping() const {
  return ping_ ? ping_->at + kPingTimeout : std::min(last_sent_ + kKeepAlive, last_ping_ + kMapClock);
}

void Client::keep_alive() {
  if (ping_ && now() >= next_ping()) {
    ping_.reset();
    ++counts_.lost_pings;
    if (++lost_pings_ == kLostPings) {
      lost_pings_ = 0;
      fail_silent();
    }
  } else if (ping_ ||
             (now() < next_ping() && device_us_ - answered_device_us_ < std::uint64_t{kKeepAlive.count()})) {
    return;
  }
  const std::uint16_t id = next_id();
  ++counts_.pings;
  ping_ = Sent{id, now()};
  last_ping_ = now();
  send(protocol::Frame(protocol::Ping{}, id).bytes());
}

bool Client::pump_until(const std::function<bool()>& done, microseconds timeout) {
  const microseconds deadline = now() + timeout;
  do {
    if (done()) return true;
    keep_alive();
    step(std::min(deadline, next_ping()));
  } while (now() < deadline || receiver_.has_more());
  return done();
}

void Client::pump(microseconds duration) {
  pump_until([] { return false; }, duration);
}

}  // namespace astro::robot
