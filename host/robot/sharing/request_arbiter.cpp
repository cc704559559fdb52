#include "host/robot/sharing/request_arbiter.hpp"

#include <algorithm>
#include <utility>

#include "common/protocol/messages.hpp"
#include "host/robot/sharing/request_rules.hpp"

namespace astro::robot {

using namespace protocol;  // NOLINT(google-build-using-namespace): this file is all messages
using std::chrono::milliseconds;

namespace {

constexpr microseconds kRepeat = milliseconds(60);  // of the relay's own requests

/// After this time the program itself has given up: a Client tries for one second, and for four at a commit.
constexpr microseconds longest_turn(std::uint8_t message) {
  return message == CommitParameters::kId ? milliseconds(4500) : milliseconds(1000);
}

}  // namespace

RequestArbiter::RequestArbiter() {
  join(kGuard, {});
  join(kSelf, {});
}

void RequestArbiter::join(SessionId id, PortUser user) {
  driver_.join(id);
  sessions_.try_emplace(id, id, std::move(user));
}

void RequestArbiter::release(SessionId id) {
  sessions_.at(id).forget();
  drive_left_ = drive_left_ || driver_.may_move(id);
  driver_.release(id);
  staging_.release(id);
  turns_.end(id);
  telemetry_.release(id);
}

void RequestArbiter::leave(SessionId id) {
  release(id);
  driver_.remove(id);
  sessions_.erase(id);
}

/// `body` has the request id that the program used.
void RequestArbiter::reply(ProgramSession& session, const Header& request, ByteView body) {
  const Bytes frame = frame_of(body);
  session.remember_answer(request, frame);
  replies_.push_back({session.id(), frame});
}

template <Message M>
void RequestArbiter::reply_with(ProgramSession& session, const Header& request, const M& message) {
  reply(session, request, body_of(message, request.request_id));
}

bool RequestArbiter::repeats(SessionId id, const Header& request) const {
  return sessions_.at(id).has_under_way(request);
}

void RequestArbiter::take(SessionId id, ByteView body, microseconds now) {
  stop_for_gone_driver(now);
  ProgramSession& session = sessions_.at(id);
  const Header header = *peek(body);  // a framer's body always has a header
  if (header.message_id == Ping::kId) return send(session, session.ping(header, body), now);
  if (session.has_answered(header)) return replies_.push_back({id, session.answer()});
  if (header.message_id == Arm::kId && owes_stop()) return;  // the program repeats it
  if (answer_here(session, header, body)) return;
  if (const auto refused = driver_.refusal(id, header.message_id))
    return reply_with(session, header, *refused);
  if (request_rules::halts(header.message_id)) {
    driver_.note_halt(id, header.message_id, session.user());
    cancel_motion(id, header.message_id);
  }
  if (session.has_under_way(header)) return repeat(session, now);
  begin(session, Exchange(header, body), now);
}

/// Must run before anything else is sent, so that this Stop does not stop the next driver.
void RequestArbiter::stop_for_gone_driver(microseconds now) {
  if (!std::exchange(drive_left_, false)) return;
  constexpr std::uint16_t kId = 1;  // the queue replaces it
  cancel_motion(kGuard, Stop::kId);
  Exchange& exchange = sessions_.at(kGuard).begin(Exchange({Stop::kId, kId}, body_of(Stop{}, kId)));
  to_robot_.send(exchange, true, now);  // with a driver's id, so that it counts as the driver's own stop
}

/// Refuses the motion requests that other programs have under way. An answer that the robot still sends to
/// one of them is dropped, so an Arm that was sent before a Stop does not undo it.
void RequestArbiter::cancel_motion(SessionId by, std::uint8_t halt) {
  const ErrorCode why = protocol::stops(halt) ? ErrorCode::not_armed : ErrorCode::busy;
  for (auto& [id, session] : sessions_) {
    if (id == by || session.current() == nullptr) continue;
    const Header request = session.current()->header;
    if (!request_rules::is_cancelled_by(request.message_id, halt)) continue;
    turns_.end(id);
    driver_.note_answer(id, request.message_id, why);
    reply_with(session, request, ErrorReply{why, 0});
  }
}

/// Answers requests that do not need the robot; returns false for all others.
bool RequestArbiter::answer_here(ProgramSession& session, const Header& header, ByteView body) {
  if (header.message_id == GetPortUsers::kId) {
    reply_with(session, header, users_for(session.id()));
    return true;
  }
  if (header.message_id == SetTelemetry::kId) {
    take_telemetry(session, header, body);
    return true;
  }
  return false;
}

PortUsers RequestArbiter::users_for(SessionId session) const {
  PortUsers users;
  if (const auto driver = driver_.confirmed_driver()) {
    users.driver_pid = sessions_.at(*driver).user().pid;
    users.driver_command = CommandLine(sessions_.at(*driver).user().command);
  }
  if (const PortUser* stopper = driver_.stopper_of(session)) {
    users.stopper_pid = stopper->pid;
    users.stopper_command = CommandLine(stopper->command);
  }
  return users;
}

void RequestArbiter::take_telemetry(ProgramSession& session, const Header& header, ByteView body) {
  const auto request = decode<SetTelemetry>(body);
  if (!request.ok()) return reply_with(session, header, ErrorReply{ErrorCode::malformed, 0});
  if ((request->fields & ~Telemetry::kAll) != 0)
    return reply_with(session, header, ErrorReply{ErrorCode::out_of_range, 0});
  telemetry_.request(session.id(), *request);
  reply_with(session, header, Ack{});
}

void RequestArbiter::send(const ProgramSession& session, Exchange& exchange, microseconds now) {
  to_robot_.send(exchange, driver_.drives(session.id()), now);
}

void RequestArbiter::begin(ProgramSession& session, Exchange exchange, microseconds now) {
  turns_.end(session.id());  // the program has given up its last request
  const std::uint8_t message = exchange.header.message_id;
  if (message == Hello::kId) return take_hello(session, std::move(exchange), now);
  driver_.note_request(session.id(), message);
  Exchange& current = session.begin(std::move(exchange));
  const bool at_once = driver_.drives(session.id()) || request_rules::halts(message);
  if (!at_once) return turns_.wait(session.id());
  if (staging_allows(session)) send(session, current, now);
}

/// The first Hello goes to the robot, where it ends the session of an earlier program. If the robot's answer
/// may have changed since, a Hello goes to the robot again, but with an onlooker's id, which ends no session.
/// All others are answered here.
void RequestArbiter::take_hello(ProgramSession& session, Exchange exchange, microseconds now) {
  const auto hello = decode<Hello>(exchange.body);
  const Header header = exchange.header;
  if (!hello.ok()) return reply_with(session, header, ErrorReply{ErrorCode::malformed, 0});
  release(session.id());
  if (!hello_) {
    Exchange& current = session.begin(std::move(exchange));
    if (driver_.driver() || greeted_) return turns_.wait(session.id());
    to_robot_.send(current, true, now);  // with a driver's id, which ends an earlier session
  } else if (hello->protocol_version != hello_->protocol_version) {
    reply_with(session, header, ErrorReply{ErrorCode::wrong_version, hello_->protocol_version});
  } else {
    reply_with(session, header, *hello_);
  }
}

void RequestArbiter::repeat(ProgramSession& session, microseconds now) {
  Exchange& exchange = *session.current();
  const std::uint8_t message = exchange.header.message_id;
  // Another program has sent Hello or drives by now, and a Hello with a driver's id would end its session.
  const bool drivers = exchange.is_sent() && !exchange.has_onlookers_id();
  if (message == Hello::kId && (hello_ || (driver_.driver() && drivers)))
    return take_hello(session, Exchange(exchange.header, Bytes(exchange.body)), now);
  if (!exchange.is_sent()) return;
  const bool takes_turns = exchange.has_onlookers_id() && !request_rules::halts(message);
  if (!takes_turns || turns_.has(session.id())) return send(session, exchange, now);
  exchange.state = Exchange::State::waits;  // its turn ended before the answer came
  turns_.wait(session.id());
}

/// Returns false if the current request was refused.
bool RequestArbiter::staging_allows(ProgramSession& session) {
  const Header header = session.current()->header;
  if (staging_.allows(session.id(), header.message_id)) return true;
  reply_with(session, header, ErrorReply{ErrorCode::staging_lost, 0});
  return false;
}

void RequestArbiter::next_onlooker(microseconds now) {
  while (const auto id = turns_.next(now)) {
    ProgramSession& session = sessions_.at(*id);
    Exchange* current = session.current();
    if (current == nullptr || current->is_sent() || !staging_allows(session)) continue;
    turns_.begin(*id, now + longest_turn(current->header.message_id));
    send(session, *current, now);
  }
}

void RequestArbiter::take_answer(ByteView body, microseconds now) {
  const Header header = *peek(body);
  for (auto& [id, session] : sessions_) {
    if (const auto ping = session.take_pong(header, now))
      return reply(session, *ping, with_request_id(body, ping->request_id));
    if (session.current() == nullptr || !session.current()->is_answered_by(header, now)) continue;
    const Header asked = session.current()->header;
    turns_.end(id);
    note_answer(session, asked.message_id, body);
    session.end();
    reply(session, asked, for_program(session, asked, body));
    return next_onlooker(now);
  }
}

/// The robot sees all programs at this port as one host, so its answer to one may contain what concerns
/// another.
Bytes RequestArbiter::for_program(const ProgramSession& session, const Header& asked, ByteView body) {
  Bytes answer = with_request_id(body, asked.request_id);
  if (asked.message_id == GetParameter::kId && staging_.hides_from(session.id()))
    return without_staged(answer);
  if (asked.message_id != GetStatus::kId) return answer;
  const auto status = decode<Status>(answer);
  if (!status.ok()) return answer;
  Status own = *status;
  own.stops_by_others = driver_.tell_stops(session.id(), own.stops_by_others);
  return body_of(own, asked.request_id);
}

void RequestArbiter::note_answer(const ProgramSession& session, std::uint8_t request, ByteView body) {
  std::optional<ErrorCode> refused;
  if (body.front() == ErrorReply::kId) {
    const auto error = decode<ErrorReply>(body);
    refused = error.ok() ? error->code : ErrorCode::malformed;
  }
  driver_.note_answer(session.id(), request, refused);
  if (request == CommitParameters::kId && !refused) hello_.reset();  // the robot's name may have changed
  if (request != Hello::kId) return;
  const auto hello = decode<HelloReply>(body);
  if (!hello.ok()) return;
  hello_ = *hello;
  greeted_ = true;
  telemetry_.renew();  // a Hello ends the telemetry of its port
}

void RequestArbiter::take_event(ByteView body) {
  if (body.front() == FaultRaised::kId) driver_.end_drive();
  if (body.front() == Booted::kId) note_restart();
}

/// After a restart the robot has forgotten all of this.
void RequestArbiter::note_restart() {
  hello_.reset();
  greeted_ = false;
  driver_.end_drive();
  staging_.clear();
  telemetry_.clear();
  turns_.clear();
  for (auto& [id, session] : sessions_) session.forget();
}

void RequestArbiter::tick(microseconds now) {
  stop_for_gone_driver(now);
  if (auto request = telemetry_.next_request()) begin(sessions_.at(kSelf), std::move(*request), now);
  for (const SessionId id : {kGuard, kSelf}) {
    const Exchange* own = sessions_.at(id).current();
    if (own != nullptr && own->is_sent() && now >= own->sent_at + kRepeat) repeat(sessions_.at(id), now);
  }
  next_onlooker(now);
}

std::optional<microseconds> RequestArbiter::next_tick() const {
  if (drive_left_) return microseconds::zero();  // at once
  std::optional<microseconds> next = turns_.deadline();
  for (const SessionId id : {kGuard, kSelf}) {
    const Exchange* own = sessions_.at(id).current();
    if (own != nullptr && own->is_sent())
      next = std::min(next.value_or(microseconds::max()), own->sent_at + kRepeat);
  }
  return next;
}

}  // namespace astro::robot
