#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "host/page/robot/driving_calls.hpp"
#include "host/page/robot/measurements.hpp"
#include "host/page/robot/opened_robot.hpp"
#include "host/page/robot/parameter_calls.hpp"
#include "host/page/robot/robot_telemetry.hpp"
#include "host/page/robot/state_event.hpp"

namespace astro::page {

/// What the pages that somebody has open can do with one robot. README.md beside this file has all calls and events.
///
/// Errors   answers, never exceptions: {"error": {"sentence", "values", "remedies"}}.
/// Threads  one.
/// Waits    answer() for the robot's answers, at most as long as the link's time-outs; step() as it is told. Only a measurement drives
///          until it is done; `Meanwhile` may answer() others from within, of which those are carried out that stop the robot.
class RobotCalls {
 public:
  static constexpr Page kAllPages = 0;
  /// Receives an event for one page, or for all of them.
  using Tell = std::function<void(Page, const nlohmann::json& event)>;
  /// Called at least every 50 ms while a measurement drives the robot; true ends it, with the robot at rest and disarmed.
  using Meanwhile = std::function<bool()>;

  /// `recordings`: its folder is that of other files, too, which calls write.
  RobotCalls(
      RobotPorts ports, RecordingPlace recordings, Tell tell, Meanwhile meanwhile = [] { return false; });
  /// A robot that a page drives is brought to rest and disarmed, which may take seconds.
  ~RobotCalls();
  RobotCalls(const RobotCalls&) = delete;
  RobotCalls& operator=(const RobotCalls&) = delete;

  /// Whether the call is one of these: "robot/...".
  static bool is_named(std::string_view call) { return call.starts_with("robot/"); }
  /// Whether the call stops the robot, or may make it move: where calls wait, those that stop it overtake all others, and what was asked
  /// before to move it is withdrawn.
  static bool stops(std::string_view call);
  static bool moves(std::string_view call);
  /// The answer to robot/ports, of which the list may take half a second: for callers that ask it in another thread.
  static nlohmann::json ports_answer(const RobotPorts& ports);

  /// `waited`: how long ago the page asked this.
  nlohmann::json answer(Page page, const std::string& call, const nlohmann::json& question,
                        microseconds waited = {});

  /// Lets the link work for this time, or until something has come, and tells what is due. The time is that of the robot's link: a
  /// simulated robot moves on by this much, and nobody waits.
  void step(microseconds most);

  /// The page has gone: what it watched ends, and a robot that it drives is stopped and disarmed.
  void leave(Page page);

  /// The clock of a simulated robot, which passes only in step() and in requests; none for any other.
  std::optional<microseconds> simulated_now() const;
  bool is_open() const { return robot_ != nullptr; }
  /// Whether step() waits for the robot. If not, whoever calls it again and again has to wait by other means.
  bool waits_for_robot() const {
    return robot_ && !robot_->is_simulated() && robot_->link().session() != nullptr;
  }
  /// Whether a velocity or a path may be under way, so that step() should be called at least every few milliseconds.
  bool armed() const { return driving_.armed(); }

 private:
  using Answer = nlohmann::json;
  static const std::map<std::string_view, Answer (RobotCalls::*)(Page, const nlohmann::json&)>& calls();

  Answer ports(Page page, const nlohmann::json& question);
  Answer open(Page page, const nlohmann::json& question);
  Answer close(Page page, const nlohmann::json& question);
  Answer watch(Page page, const nlohmann::json& question);
  Answer arm(Page page, const nlohmann::json& question);
  Answer disarm(Page page, const nlohmann::json& question);
  Answer stop(Page page, const nlohmann::json& question);
  Answer pause(Page page, const nlohmann::json& question);
  Answer resume(Page page, const nlohmann::json& question);
  Answer emergency_stop(Page page, const nlohmann::json& question);
  Answer clear_faults(Page page, const nlohmann::json& question);
  Answer drive(Page page, const nlohmann::json& question);
  Answer path(Page page, const nlohmann::json& question);
  Answer parameters(Page page, const nlohmann::json& question);
  Answer stage(Page page, const nlohmann::json& question);
  Answer commit(Page page, const nlohmann::json& question);
  Answer discard(Page page, const nlohmann::json& question);
  Answer record(Page page, const nlohmann::json& question);
  Answer remove_recording(Page page, const nlohmann::json& question);
  Answer export_parameters(Page page, const nlohmann::json& question);
  Answer judge_wiring(Page page, const nlohmann::json& question);
  Answer roll(Page page, const nlohmann::json& question);

  using Measure = Answer (Measurements::*)(const Measurements::Task&, const nlohmann::json&);
  static const std::map<std::string_view, Measure>& measurements();
  Answer measure(Page page, Measure what, const nlohmann::json& question);
  bool measurement_has_to_end();
  Answer answer_meanwhile(Page page, const std::string& call, const nlohmann::json& question);
  const protocol::Telemetry& fresh_telemetry();
  OpenedRobot& robot();
  live::RobotSession& session() { return robot().required_session(); }
  live::RobotSession& known_session();
  live::RobotSession& current_session();
  void require_no_close() const;
  void finish_close();
  void forget_robot();
  Answer description(Page page);
  void work(microseconds most);
  void pump(live::RobotSession& session, microseconds most);
  void lose(const Error& why);
  void look_for_other_driver(live::RobotSession& session);
  void report();
  RobotState state() const;

  RobotPorts ports_;
  std::filesystem::path folder_;
  Tell tell_;
  std::unique_ptr<OpenedRobot> robot_;
  DrivingCalls driving_;                       // behind robot_, whose session it may use
  std::map<Page, ParameterCalls> parameters_;  // a page puts in force what it has staged, and nobody else has
  RobotTelemetry telemetry_;
  Meanwhile meanwhile_;
  Measurements measurements_;      // of this robot, until it is lost: one that restarts counts anew
  std::optional<Page> measuring_;  // for this page, at this moment
  bool stop_measurement_ = false, emergency_ = false;  // a page has asked for it meanwhile
  microseconds report_at_{};                           // of a measurement
  bool closing_ = false;                               // the robot is brought to rest first
  microseconds waited_{};                              // of the question that is being answered
  std::string other_driver_;
  microseconds look_at_{};  // for another program that drives
  StateReport state_report_;
};

}  // namespace astro::page
