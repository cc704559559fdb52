#include "host/ros2/driver/robot_link.hpp"

namespace astro::ros2 {

namespace {

constexpr microseconds kBetweenTries = std::chrono::milliseconds(200);

}  // namespace

bool RobotLink::seek() {
  if (session_ || (tried_ && clock_.steady() - *tried_ < kBetweenTries)) return false;
  try {
    session_ = std::make_unique<RobotSession>(open_(), robot_, period_ms_);
    robot_ = session_->client().robot();
    tried_.reset();
  } catch (const Error& error) {
    why_ = error;
    tried_ = clock_.steady();
  }
  return session_ != nullptr;
}

void RobotLink::lose(const Error& why) {
  why_ = why;
  session_.reset();
  ++losses_;
}

}  // namespace astro::ros2
