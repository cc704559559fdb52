#pragma once

#include <functional>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "host/page/robot/driving_calls.hpp"
#include "host/page/robot/opened_robot.hpp"
#include "host/page/robot/recordings.hpp"
#include "host/page/robot/signal_watch.hpp"

namespace astro::page {

/// The telemetry of the open robot: its newest sample, what pages watch of it, and what is recorded. The robot is asked for one telemetry
/// that serves all of them.
class RobotTelemetry {
 public:
  using Answer = nlohmann::json;

  explicit RobotTelemetry(RecordingPlace place) : recordings_(std::move(place)) {}

  Answer watch(OpenedRobot& robot, Page page, const nlohmann::json& question);
  /// Precondition: none is under way. Throws as Recordings::begin.
  Answer begin_recording(OpenedRobot& robot);
  Answer end_recording(OpenedRobot* robot);
  void remove_recording(const std::string& file) { recordings_.remove(file); }
  /// Throws if one is under way, which whoever asked has to end first.
  void require_no_recording() const;
  bool recording() const { return recordings_.under_way(); }
  const Recordings& recordings() const { return recordings_; }

  /// Asks for what is needed now; of no robot (null) it is asked once there is one.
  void ask(OpenedRobot* robot);
  /// Takes the samples that have come.
  void take_from(OpenedRobot& robot, live::RobotSession& session);
  /// A recording that has no more room ends here: the sentence for people, none otherwise.
  std::optional<std::string> end_full_recording(OpenedRobot& robot);

  const std::optional<protocol::Telemetry>& newest() const { return newest_; }
  /// What is known of the robot is no longer true: its link was lost, or found again.
  void forget_newest() { newest_.reset(); }
  /// Nobody watches any more.
  void forget_robot();
  void leave(Page page) { watches_.erase(page); }

  /// Tells the pages which samples are due, and where the robot is.
  void report(const OpenedRobot& robot, const std::function<void(Page, const nlohmann::json& event)>& tell);

 private:
  void take(OpenedRobot& robot, const protocol::Telemetry& telemetry);

  std::map<Page, SignalWatch> watches_;
  std::uint16_t period_ms_ = 0;  // of the telemetry that was asked for
  std::optional<protocol::Telemetry> newest_;
  Recordings recordings_;
};

}  // namespace astro::page
