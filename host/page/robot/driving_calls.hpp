#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "host/live/driver/driving.hpp"
#include "host/page/robot/path_drive.hpp"

namespace astro::page {

/// Counts from 1 in the order in which pages came.
using Page = int;

/// Who drives an open robot, and what is driven. The rules of driving are those of live::Driving; here is added that one of several
/// pages drives, and what becomes of the robot when that page goes.
///
/// Errors  RobotCallProblem: another page drives, the robot is not armed for this page or was stopped, a path is under way; what
///         a request throws.
class DrivingCalls {
 public:
  using Answer = nlohmann::json;

  /// For what so long a velocity holds; a page that wants to drive on repeats it.
  static constexpr microseconds kHold = std::chrono::milliseconds(250);

  Answer arm(live::RobotSession& session, Page page);
  /// A robot that moves is brought to rest first, and disarmed by a step() then: without power it would roll on.
  Answer disarm(live::RobotSession& session);
  /// Whoever asks.
  Answer stop(live::RobotSession& session);
  Answer emergency_stop(live::RobotSession& session);
  Answer pause(live::RobotSession& session);
  Answer resume(live::RobotSession& session, Page page);
  /// `waited`: how long ago the page asked; a velocity that is older than it holds is refused.
  Answer drive(live::RobotSession& session, Page page, const nlohmann::json& question, microseconds waited);
  Answer path(live::RobotSession& session, Page page, const nlohmann::json& question);

  /// Sends what is due, goes on with a path, and disarms a robot that came to rest after its page had gone.
  void step(live::RobotSession& session);
  /// The page has gone: if it drives, finish().
  void leave(live::RobotSession& session, Page page);
  /// The robot is stopped now, and disarmed by a step() once it is at rest, if a page drives it.
  void finish(live::RobotSession& session);
  /// Stops the robot, waits for its rest and disarms it, if a page drives it. Throws astro::Error if it does not come to rest.
  /// `meanwhile`: as of robot::wait_until_power_off.
  void end(
      live::RobotSession& session, const std::function<void()>& meanwhile = [] {});
  /// Nobody drives any more: of a fault, or of a link that is lost. Must be called before its session ends.
  void release(const std::string& why);

  bool armed() const { return driving_.armed(); }
  /// Throws unless nobody drives, or this page.
  void require_free_for(Page page) const;
  /// 0: none.
  Page driver() const { return driving_.armed() ? driver_ : 0; }
  bool path_under_way() const { return path_ && !path_->ended(); }
  /// How the path goes on; none without one, and after its end was told.
  std::optional<nlohmann::json> path_event(const protocol::Telemetry& newest, microseconds now);

 private:
  void require_driver(Page page) const;
  void end_path(const std::string& why);
  void rest_and_disarm(live::RobotSession& session);
  void disarm_at_rest(live::RobotSession& session);

  live::Driving driving_{kHold};
  Page driver_ = 0;
  bool stopped_ = false;  // since it was armed
  std::optional<PathDrive> path_;
  std::string path_ended_;  // early, and not told yet
  double path_done_ = 0;    // as it was told last
  std::optional<microseconds> path_told_at_;
  /// After finish(): when the robot is asked next whether it is at rest, and when it is disarmed anyway.
  std::optional<microseconds> ask_rest_at_;
  microseconds disarm_at_{};
};

}  // namespace astro::page
