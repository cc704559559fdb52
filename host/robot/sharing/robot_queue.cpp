#include "host/robot/sharing/robot_queue.hpp"

#include "host/robot/sharing/request_rules.hpp"

namespace astro::robot {

namespace {

constexpr std::size_t kMostQueuedFrames = 256;

}  // namespace

std::uint16_t RobotQueue::fresh_id(bool drivers) {
  constexpr std::uint16_t kLast = protocol::kOnlookerBit - 1;
  last_id_ = static_cast<std::uint16_t>(last_id_ >= kLast ? 1 : last_id_ + 1);
  return drivers ? last_id_ : static_cast<std::uint16_t>(last_id_ | protocol::kOnlookerBit);
}

void RobotQueue::send(Exchange& exchange, bool drivers, microseconds now) {
  if (exchange.robot_id == 0) {
    exchange.robot_id = fresh_id(drivers);
    exchange.frame = frame_of(with_request_id(exchange.body, exchange.robot_id));
  }
  exchange.state = Exchange::State::sent;
  exchange.sent_at = now;
  const std::uint8_t message = exchange.header.message_id;
  const bool first = protocol::stops(message);
  if (first) frames_.withdraw();
  if (frames_.frames() >= (request_rules::halts(message) ? 2 : 1) * kMostQueuedFrames) return;
  first ? frames_.push_first(exchange.frame)
        : frames_.push(exchange.frame, request_rules::sets_in_motion(message));
}

}  // namespace astro::robot
