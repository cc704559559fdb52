#include "host/page/robot/robot_calls.hpp"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "host/base/error.hpp"
#include "host/base/interrupted.hpp"
#include "host/experiment/analysis/calibration_file.hpp"
#include "host/experiment/drive/record_run.hpp"
#include "host/experiment/files/robot_identity.hpp"
#include "host/page/calls/attempt.hpp"
#include "host/page/calls/question.hpp"
#include "host/page/calls/simulated_robot.hpp"
#include "host/page/robot/robot_call_problem.hpp"
#include "host/robot/client/handshake.hpp"
#include "host/robot/client/restore.hpp"
#include "host/robot/motion/other_program.hpp"

namespace astro::page {
namespace {

using nlohmann::json;
using protocol::Telemetry;
using std::chrono::milliseconds;
using std::chrono::seconds;

/// The longest wait of the link before what is due is looked at again.
constexpr microseconds kSlice = milliseconds(1), kSliceUnarmed = milliseconds(5);

std::vector<std::string> remedies_of(const Error& error) {
  if (error.kind() == Kind(RobotCallProblem::needs_confirmation)) return {"confirm"};
  return {};
}

json signals_json() {
  json list = json::array();
  for (const Signal& each : signals())
    list.push_back({{"name", each.name}, {"unit", each.unit}, {"group", each.group}});
  return list;
}

}  // namespace

RobotCalls::RobotCalls(RobotPorts ports, RecordingPlace recordings, Tell tell, Meanwhile meanwhile)
    : ports_(std::move(ports)),
      folder_(recordings.folder),
      tell_(std::move(tell)),
      telemetry_(std::move(recordings)),
      meanwhile_(std::move(meanwhile)) {}

RobotCalls::~RobotCalls() {
  try {
    if (live::RobotSession* found = robot_ ? robot_->session() : nullptr) driving_.end(*found);
  } catch (const std::exception&) {  // a robot that cannot be reached stops by its own time-out
  }
  try {
    if (robot_) forget_robot();
  } catch (const std::exception&) {  // there is nobody left to be told
  }
}

const std::map<std::string_view, json (RobotCalls::*)(Page, const json&)>& RobotCalls::calls() {
  static const std::map<std::string_view, json (RobotCalls::*)(Page, const json&)> all{
      {"robot/ports", &RobotCalls::ports},
      {"robot/open", &RobotCalls::open},
      {"robot/close", &RobotCalls::close},
      {"robot/watch", &RobotCalls::watch},
      {"robot/arm", &RobotCalls::arm},
      {"robot/disarm", &RobotCalls::disarm},
      {"robot/stop", &RobotCalls::stop},
      {"robot/pause", &RobotCalls::pause},
      {"robot/resume", &RobotCalls::resume},
      {"robot/emergency_stop", &RobotCalls::emergency_stop},
      {"robot/clear_faults", &RobotCalls::clear_faults},
      {"robot/drive", &RobotCalls::drive},
      {"robot/path", &RobotCalls::path},
      {"robot/parameters", &RobotCalls::parameters},
      {"robot/stage", &RobotCalls::stage},
      {"robot/commit", &RobotCalls::commit},
      {"robot/discard", &RobotCalls::discard},
      {"robot/record", &RobotCalls::record},
      {"robot/remove_recording", &RobotCalls::remove_recording},
      {"robot/export", &RobotCalls::export_parameters},
      {"robot/judge_wiring", &RobotCalls::judge_wiring},
      {"robot/roll", &RobotCalls::roll}};
  return all;
}

json RobotCalls::answer(Page page, const std::string& call, const json& question, microseconds waited) {
  const auto found = calls().find(call);
  const auto measurement = measurements().find(call);
  if (found == calls().end() && measurement == measurements().end())
    return refusal("there is no call '" + call + "'", {call});
  if (!question.is_object()) return refusal("the question is no object");
  if (measuring_) return answer_meanwhile(page, call, question);
  waited_ = waited;
  json told = attempt(
      [&] {
        try {
          return found != calls().end() ? (this->*found->second)(page, question)
                                        : measure(page, measurement->second, question);
        } catch (const robot::LinkLost& error) {
          lose(error);
          throw;
        }
      },
      remedies_of);
  report();
  return told;
}

bool RobotCalls::stops(std::string_view call) {
  constexpr std::array<std::string_view, 4> kStops{"robot/stop", "robot/pause", "robot/emergency_stop",
                                                   "robot/disarm"};
  return std::ranges::find(kStops, call) != kStops.end();
}

bool RobotCalls::moves(std::string_view call) {
  constexpr std::array<std::string_view, 8> kMoves{"robot/arm",         "robot/drive",       "robot/path",
                                                   "robot/resume",      "robot/probe_motor", "robot/tune",
                                                   "robot/load_tuning", "robot/experiment"};
  return std::ranges::find(kMoves, call) != kMoves.end();
}

json RobotCalls::ports_answer(const RobotPorts& ports) {
  return attempt(
      [&] {
        json list = json::array();
        for (const RobotPort& each : ports.list()) list.push_back({{"path", each.path}, {"what", each.what}});
        return json{{"ports", list}};
      },
      remedies_of);
}

json RobotCalls::ports(Page, const json&) {
  const json told = ports_answer(ports_);
  return told.contains("result") ? told["result"] : throw Error(told["error"]["sentence"].get<std::string>());
}

OpenedRobot& RobotCalls::robot() {
  if (!robot_) throw Error("no robot is open: open one first", RobotCallProblem::no_robot);
  return *robot_;
}

live::RobotSession& RobotCalls::known_session() {
  live::RobotSession& found = session();
  if (!found.knows_parameters())
    throw Error("the robot was found just now, and its parameters are being read: ask again");
  return found;
}

/// The same with the parameters as the robot has them: another program may have changed them.
live::RobotSession& RobotCalls::current_session() {
  live::RobotSession& found = known_session();
  if (driving_.armed()) return found;  // nobody can change them, and the link has no time for the table
  found.parameters().refresh();
  found.note_parameters();
  return found;
}

json RobotCalls::open(Page page, const json& question) {
  require_no_close();
  const std::string port = text_in(question, "port");
  const auto simulated = question.find("simulated");
  const bool asks_for_one = !port.empty() || simulated != question.end();
  if (robot_ && asks_for_one && (simulated != question.end() || port != robot_->port()))
    throw Error("another robot is open: close it first", RobotCallProblem::another_robot, {robot_->port()});
  if (!robot_ && !asks_for_one) robot();
  if (simulated != question.end() && !simulated->is_object()) throw Error("simulated is no object");
  if (!robot_) {
    robot_ = port.empty() ? OpenedRobot::simulated(simulated_robot_in(*simulated))
                          : OpenedRobot::at_port(ports_, port);
    telemetry_.ask(robot_.get());
  }
  return description(page);
}

json RobotCalls::description(Page page) {
  live::RobotSession& found = known_session();
  const protocol::HelloReply& robot = found.client().robot();
  json told = parameters_[page].list(found);
  told.update({{"port", robot_->port()},
               {"name", experiment::info_of(robot, {}).robot_name},
               {"unique_id", experiment::identity_of(robot).id},
               {"firmware", robot::firmware_version(robot)},
               {"hardware", robot.board.view()},
               {"page", page},
               {"simulated", robot_->is_simulated()},
               {"signals", signals_json()}});
  return told;
}

json RobotCalls::close(Page page, const json&) {
  if (!robot_ || closing_) return json::object();
  driving_.require_free_for(page);
  if (live::RobotSession* found = robot_->session()) driving_.finish(*found);
  closing_ = true;
  if (telemetry_.recording()) telemetry_.end_recording(robot_.get());
  finish_close();
  return json::object();
}

/// What opens, arms or records a robot waits until it is closed.
void RobotCalls::require_no_close() const {
  if (closing_) throw Error("the robot is brought to rest and closed: ask again once it is");
}

/// A stop is answered meanwhile, so nobody waits here for a robot's ramp.
void RobotCalls::finish_close() {
  if (closing_ && (!driving_.armed() || robot_->session() == nullptr)) forget_robot();
}

void RobotCalls::forget_robot() {
  closing_ = false;
  driving_.release("the robot was closed");
  report();
  robot_.reset();
  telemetry_.forget_robot();
  parameters_.clear();
  measurements_ = {};
  other_driver_.clear();
}

json RobotCalls::watch(Page page, const json& question) { return telemetry_.watch(robot(), page, question); }

json RobotCalls::arm(Page page, const json&) {
  require_no_close();
  return driving_.arm(known_session(), page);
}
json RobotCalls::disarm(Page, const json&) { return driving_.disarm(session()); }
json RobotCalls::stop(Page, const json&) { return driving_.stop(session()); }
json RobotCalls::pause(Page, const json&) { return driving_.pause(session()); }
json RobotCalls::resume(Page page, const json&) { return driving_.resume(session(), page); }
json RobotCalls::emergency_stop(Page, const json&) { return driving_.emergency_stop(session()); }
json RobotCalls::clear_faults(Page, const json&) {
  session().ask(protocol::ClearFaults{});
  return {{"notice", "cleared"}};
}
json RobotCalls::drive(Page page, const json& question) {
  return driving_.drive(session(), page, question, waited_);
}
json RobotCalls::path(Page page, const json& question) { return driving_.path(session(), page, question); }
json RobotCalls::parameters(Page page, const json&) { return parameters_[page].list(current_session()); }
json RobotCalls::stage(Page page, const json& question) {
  return parameters_[page].stage(known_session(), question);
}
json RobotCalls::commit(Page page, const json& question) {
  driving_.require_free_for(page);
  return parameters_[page].commit(known_session(), question);
}
json RobotCalls::discard(Page page, const json&) { return parameters_[page].discard(); }

json RobotCalls::record(Page, const json& question) {
  if (!flag_in(question, "on")) return telemetry_.end_recording(robot_.get());
  telemetry_.require_no_recording();
  require_no_close();
  known_session();
  return telemetry_.begin_recording(*robot_);
}

json RobotCalls::remove_recording(Page, const json& question) {
  telemetry_.remove_recording(text_in(question, "file"));
  return json::object();
}

json RobotCalls::export_parameters(Page, const json&) {
  experiment::ParameterValues values;
  for (const robot::ParameterRow& row : current_session().parameters().rows())
    values[row.name] = robot::to_value(row, row.active);
  const std::filesystem::path file = std::filesystem::path(kMade) / "robot.toml";
  std::filesystem::create_directories(folder_ / kMade);
  experiment::write_parameters(folder_ / file, values);
  return {{"file", file.string()}};
}

const std::map<std::string_view, RobotCalls::Measure>& RobotCalls::measurements() {
  static const std::map<std::string_view, Measure> all{{"robot/probe_motor", &Measurements::probe_motor},
                                                       {"robot/push", &Measurements::push},
                                                       {"robot/tune", &Measurements::tune},
                                                       {"robot/load_tuning", &Measurements::load_tuning},
                                                       {"robot/experiment", &Measurements::experiment}};
  return all;
}

json RobotCalls::judge_wiring(Page, const json& question) {
  return measurements_.judge_wiring(current_session(), question);
}
json RobotCalls::roll(Page, const json& question) {
  live::RobotSession& found = current_session();
  return measurements_.roll(found, fresh_telemetry(), question);
}

/// A measurement asks for a telemetry of its own, so none of it is shown or recorded meanwhile.
json RobotCalls::measure(Page page, Measure what, const json& question) {
  require_no_close();
  driving_.require_free_for(page);
  telemetry_.require_no_recording();
  live::RobotSession& found = known_session();
  robot::DriveHooks drive;
  drive.interrupted = [this] { return measurement_has_to_end(); };
  drive.resting = [this] { measurement_has_to_end(); };
  drive.notice = [&](const Remark& remark) {
    tell_(page, {{"event", "notice"}, {"sentence", remark.sentence}});
  };
  const auto tell = [&](const json& event) { tell_(page, event); };
  const auto ended = [&] {
    while (found.take_sample()) {
    }
    found.take_fault();
    telemetry_.ask(robot_.get());
    found.parameters().refresh();
    found.note_parameters();
  };
  stop_measurement_ = emergency_ = false;
  report_at_ = robot_->now();
  const robot::Restore measuring(measuring_, std::optional(page));
  report();  // now, so that a page that leaves knows that it has to stop the robot
  try {
    driving_.end(found, drive.resting);
    if (measurement_has_to_end()) throw Interrupted("stopped before anything was measured");
    const json told = (measurements_.*what)({*robot_, current_session(), drive, tell, folder_}, question);
    ended();
    return told;
  } catch (const robot::LinkLost&) {
    throw;
  } catch (const std::exception& error) {
    try {
      ended();
    } catch (const std::exception&) {
      // The next step() tells that the link is lost; what is thrown here is why the measurement ended.
    }
    // Whoever drives knows nothing of it, and takes it for another program's.
    if (emergency_ && dynamic_cast<const Interrupted*>(&error) == nullptr)
      throw Interrupted("the emergency stop ended the measurement");
    throw;
  }
}

bool RobotCalls::measurement_has_to_end() {
  constexpr microseconds kBetweenReports = milliseconds(200);
  while (robot_->session()->take_sample()) {
  }
  if (robot_->now() >= report_at_) {
    report_at_ = robot_->now() + kBetweenReports;
    report();
  }
  // A question that is answered from within ends here, too.
  if (meanwhile_()) stop_measurement_ = true;
  return stop_measurement_;
}

/// The link is not given up here, because the measurement still uses it.
json RobotCalls::answer_meanwhile(Page page, const std::string& call, const json& question) {
  return attempt(
      [&]() -> json {
        // This asks the robot nothing, and a page that knows the robot can stop it.
        if (call == "robot/open") return open(page, question);
        const bool emergency = call == "robot/emergency_stop";
        if (!stops(call))
          throw Error("the robot is being measured: stop it, or ask again when that is done",
                      RobotCallProblem::measuring);
        stop_measurement_ = true;
        if (emergency) {
          session().ask(protocol::EmergencyStop{});
          emergency_ = true;
        }
        return {{"notice", emergency ? "the motors are off" : "the measurement ends"}};
      },
      remedies_of);
}

/// Telemetry that the robot took after this call.
const Telemetry& RobotCalls::fresh_telemetry() {
  live::RobotSession& found = known_session();
  const std::uint64_t asked_us = found.device_now_us();
  const microseconds end = found.client().now() + seconds(1);
  do {
    if (found.client().now() >= end) throw Error("the robot sends no telemetry: ask again");
    pump(found, milliseconds(20));
  } while (!telemetry_.newest() || telemetry_.newest()->device_time_us < asked_us);
  return *telemetry_.newest();
}

void RobotCalls::step(microseconds most) {
  if (!robot_) return report();
  const microseconds until = robot_->now() + most;
  do {
    try {
      work(
          std::clamp(until - robot_->now(), microseconds::zero(), driving_.armed() ? kSlice : kSliceUnarmed));
    } catch (const Error& error) {
      lose(error);
    }
  } while (robot_->session() != nullptr && robot_->now() < until);
  finish_close();
  report();
}

void RobotCalls::work(microseconds most) {
  if (robot_->seek()) telemetry_.forget_newest();
  live::RobotSession* found = robot_->session();
  if (found == nullptr) return;
  if (!found->knows_parameters()) found->read_parameters(milliseconds(5));
  driving_.step(*found);
  pump(*found, most);
  found->keep_telemetry();
  look_for_other_driver(*found);
  if (const auto full = telemetry_.end_full_recording(*robot_))
    tell_(kAllPages, {{"event", "notice"}, {"sentence", *full}});
}

void RobotCalls::pump(live::RobotSession& session, microseconds most) {
  session.pump(most);
  if (session.restarted()) throw robot::LinkLost("the robot has restarted");
  if (session.take_fault()) driving_.release("the robot stopped by itself");
  telemetry_.take_from(*robot_, session);
}

/// Another program at the same port may drive, of which the robot itself says nothing.
void RobotCalls::look_for_other_driver(live::RobotSession& session) {
  if (robot_->is_simulated() || session.client().now() < look_at_) return;
  look_at_ = session.client().now() + seconds(1);
  if (driving_.armed()) return other_driver_.clear();
  const robot::PortUsers users = robot::port_users(session.client());
  other_driver_ = users.driver_pid == 0 ? "" : robot::driven_by_another(users).sentence;
}

void RobotCalls::lose(const Error& why) {
  driving_.release("the link to the robot was lost");
  if (robot_) robot_->lose(why);
  telemetry_.forget_newest();
  measurements_ = {};
  other_driver_.clear();
}

RobotState RobotCalls::state() const {
  RobotState state;
  state.open = robot_ != nullptr;
  state.measuring = measuring_.has_value();
  state.armed = driving_.armed() || state.measuring;
  state.driver = measuring_.value_or(driving_.driver());
  state.telemetry = telemetry_.newest();
  if (robot_ && robot_->link().losses() > 0 && !state.telemetry) state.why_lost = robot_->link().why().what();
  state.other_driver = other_driver_;
  state.recording = telemetry_.recordings().file();
  state.recordings = telemetry_.recordings().ended();
  return state;
}

void RobotCalls::report() {
  const microseconds now = robot_ ? robot_->now() : ports_.clock.steady();
  if (const auto event = state_report_.take(state(), now)) tell_(kAllPages, *event);
  const Telemetry newest = telemetry_.newest().value_or(Telemetry{});
  if (const auto event = driving_.path_event(newest, now)) tell_(kAllPages, *event);
  if (robot_ && telemetry_.newest() && !measuring_) telemetry_.report(*robot_, tell_);
}

void RobotCalls::leave(Page page) {
  telemetry_.leave(page);
  parameters_.erase(page);
  if (!robot_) return;
  if (measuring_) {
    if (*measuring_ == page) stop_measurement_ = true;
    return;
  }
  try {
    if (live::RobotSession* found = robot_->session()) driving_.leave(*found, page);
    telemetry_.ask(robot_.get());  // last: a stop does not wait for it
  } catch (const Error& error) {
    lose(error);
  }
  report();
}

std::optional<microseconds> RobotCalls::simulated_now() const {
  return robot_ && robot_->is_simulated() ? std::optional(robot_->now()) : std::nullopt;
}

}  // namespace astro::page
