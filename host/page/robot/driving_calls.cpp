#include "host/page/robot/driving_calls.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <utility>

#include "host/base/error.hpp"
#include "host/experiment/files/plan.hpp"
#include "host/page/calls/question.hpp"
#include "host/page/robot/robot_call_problem.hpp"
#include "host/robot/motion/paths.hpp"
#include "host/robot/motion/rest.hpp"

namespace astro::page {
namespace {

using nlohmann::json;
using std::chrono::milliseconds;

constexpr microseconds kBetweenPathEvents = milliseconds(100);
constexpr microseconds kBetweenAsking = milliseconds(50);

json notice(const std::string& sentence) { return {{"notice", sentence}}; }

/// `forward` for a line, and cw or ccw for what turns; the usual one if it is missing.
bool is_named(const json& question, const char* usual, const char* other) {
  const std::string direction = text_in(question, "direction");
  if (!direction.empty() && direction != usual && direction != other)
    throw Error(fmt::format("direction is '{}', and must be {} or {}", direction, usual, other));
  return direction != other;
}

robot::Path path_in(const json& question) {
  const experiment::Plan usual;
  const double size_m = number_in(question, "size_m", 0.05, 20).value_or(1);
  const robot::PathLimits limits{number_in(question, "speed_mps", 0.02, 2).value_or(usual.speed_mps),
                                 usual.yaw_rate_radps};
  const std::string kind = text_in(question, "kind");
  if (kind == "line")
    return robot::line(is_named(question, "forward", "backward") ? size_m : -size_m, limits);
  const auto sense = [&] { return is_named(question, "ccw", "cw") ? Sense::ccw : Sense::cw; };
  if (kind == "square") return robot::square(size_m, sense(), limits);
  if (kind == "circle") return robot::circle(size_m, 1, sense(), limits);
  throw Error(fmt::format("kind is '{}', and must be line, square or circle", kind));
}

}  // namespace

void DrivingCalls::require_free_for(Page page) const {
  if (driving_.armed() && !stopped_ && driver_ != page)
    throw Error("another page drives the robot: stop it first, or drive there",
                RobotCallProblem::another_page, {std::to_string(driver_)});
}

void DrivingCalls::require_driver(Page page) const {
  require_free_for(page);
  if (!driving_.armed() || driver_ != page)
    throw Error("the robot is not armed for this page: arm it first", RobotCallProblem::not_armed);
  if (const std::string_view why = driving_.why_ignored(); !why.empty())
    throw Error(std::string(why), RobotCallProblem::halted);
}

json DrivingCalls::arm(live::RobotSession& session, Page page) {
  require_free_for(page);
  const std::string done = driving_.arm(session);
  driver_ = page;
  stopped_ = false;
  ask_rest_at_.reset();
  return notice(done);
}

json DrivingCalls::disarm(live::RobotSession& session) {
  end_path("the robot was disarmed");
  if (protocol::gives_power(session.ask(protocol::GetStatus{}).mode)) {
    rest_and_disarm(session);
    return notice("ramps to rest, and is disarmed then");
  }
  driving_.disarm(session);
  ask_rest_at_.reset();
  return notice("disarmed");
}

json DrivingCalls::stop(live::RobotSession& session) {
  const std::string done = driving_.stop(session);
  stopped_ = true;
  end_path("the robot was stopped");
  return notice(done);
}

json DrivingCalls::emergency_stop(live::RobotSession& session) {
  session.ask(protocol::EmergencyStop{});  // first, and if it fails the robot is still known to be armed
  driving_.release();
  ask_rest_at_.reset();
  end_path("the robot was stopped");
  return notice("the motors are off");
}

json DrivingCalls::pause(live::RobotSession& session) {
  driving_.pause(session);
  return notice("paused");
}

json DrivingCalls::resume(live::RobotSession& session, Page page) {
  require_free_for(page);
  if (stopped_) throw Error(std::string(driving_.why_ignored()), RobotCallProblem::halted);
  return notice(driving_.resume(session));
}

json DrivingCalls::drive(live::RobotSession& session, Page page, const json& question, microseconds waited) {
  constexpr double kFastest = 100;  // m/s and rad/s; the robot's own limits are far below
  require_driver(page);
  if (path_under_way())
    throw Error("the robot drives a path: stop it first", RobotCallProblem::path_under_way);
  if (waited >= kHold) throw Error("the velocity came too late to be driven");
  ros2::msg::Twist twist;
  twist.linear.x = number_in(question, "v_mps", -kFastest, kFastest).value_or(0);
  twist.angular.z = number_in(question, "w_radps", -kFastest, kFastest).value_or(0);
  const microseconds now = session.client().now();
  driving_.take(std::optional(twist), {now, 0, waited});
  driving_.step(session, now);
  if (!driving_.armed()) throw Error(driving_.counts().last_reason, RobotCallProblem::halted);
  return json::object();
}

json DrivingCalls::path(live::RobotSession& session, Page page, const json& question) {
  require_driver(page);
  if (path_under_way())
    throw Error("the robot drives a path already: stop it first", RobotCallProblem::path_under_way);
  robot::Path path = path_in(question);
  path_ended_.clear();
  path_done_ = 0;
  path_told_at_.reset();
  path_.emplace(session, std::move(path));
  return {{"segments", path_->segments()}};
}

void DrivingCalls::step(live::RobotSession& session) {
  driving_.step(session, session.client().now());
  if (path_) path_->step();
  if (ask_rest_at_ && session.client().now() >= *ask_rest_at_) disarm_at_rest(session);
}

void DrivingCalls::leave(live::RobotSession& session, Page page) {
  if (driver_ == page) finish(session);
}

void DrivingCalls::finish(live::RobotSession& session) {
  if (driving_.armed()) rest_and_disarm(session);
}

void DrivingCalls::rest_and_disarm(live::RobotSession& session) {
  stop(session);
  driver_ = 0;
  disarm_at_ = session.client().now() + robot::longest_stop(session.numbers());
  disarm_at_rest(session);
}

void DrivingCalls::disarm_at_rest(live::RobotSession& session) {
  const microseconds now = session.client().now();
  ask_rest_at_ = now + kBetweenAsking;
  if (now < disarm_at_ && protocol::gives_power(session.ask(protocol::GetStatus{}).mode)) return;
  ask_rest_at_.reset();
  driving_.disarm(session);
}

void DrivingCalls::end(live::RobotSession& session, const std::function<void()>& meanwhile) {
  if (!driving_.armed()) return;
  stop(session);
  const bool rests = robot::wait_until_power_off(session.client(), meanwhile);
  driving_.disarm(session);
  path_.reset();
  if (!rests) throw Error("the robot did not come to rest and was disarmed: it may roll on");
}

void DrivingCalls::release(const std::string& why) {
  driving_.release();
  ask_rest_at_.reset();
  end_path(why);
}

void DrivingCalls::end_path(const std::string& why) {
  if (path_under_way()) path_ended_ = why;
  if (!path_ended_.empty()) path_.reset();
}

std::optional<json> DrivingCalls::path_event(const protocol::Telemetry& newest, microseconds now) {
  const auto event = [](double done, const json& ended) {
    return json{{"event", "path"}, {"done", done}, {"ended", ended}};
  };
  if (!path_ended_.empty()) return event(path_done_, std::exchange(path_ended_, {}));
  if (!path_) return std::nullopt;
  path_done_ = path_->done(newest);
  if (path_->ended()) {
    const json last = event(path_done_, *path_->ended());
    path_.reset();
    return last;
  }
  if (path_told_at_ && now - *path_told_at_ < kBetweenPathEvents) return std::nullopt;
  path_told_at_ = now;
  return event(path_done_, nullptr);
}

}  // namespace astro::page
