#include "host/ros2/driver/driver.hpp"

#include <algorithm>
#include <cmath>

#include "host/robot/motion/rest.hpp"
#include "host/ros2/recorded/ros_messages.hpp"

namespace astro::ros2 {

using std::chrono::milliseconds;

namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;
// While velocities drive the robot, none of them waits behind a sleep that is longer than a control tick. Otherwise only
// services wait, and processor time counts more.
constexpr microseconds kTick = milliseconds(1), kIdle = milliseconds(5);

std::uint16_t period_ms(double rate_hz) {
  return static_cast<std::uint16_t>(std::clamp(std::lround(1000 / rate_hz), 1L, 60'000L));
}

std::vector<FixedParameter> fixed_parameters(const DriverOptions& options, const Names& names) {
  return {{"odom_frame_id", "frame of odometry", to_parameter(names.frame(kOdomFrame))},
          {"base_frame_id", "frame of the robot, on the floor between its wheels",
           to_parameter(names.frame(kFootprintFrame))},
          {"publish_rate", "messages of odometry a second [Hz]",
           to_parameter(1000.0 / period_ms(options.rate_hz))},
          {"cmd_vel_timeout", "how long a velocity holds [s]",
           to_parameter(1e-6 * static_cast<double>(options.cmd_vel_timeout.count()))},
          {"cmd_vel_after_stop", "velocities drive the robot again after this node's stop, without arm",
           to_parameter(options.velocities_after_stop)}};
}

}  // namespace

Driver::Driver(std::vector<Middleware*> middlewares, OpenPort open, DriverOptions options)
    : middlewares_(std::move(middlewares)),
      options_(std::move(options)),
      names_(options_.node_namespace),
      utc_(options_.clock),
      polled_(utc_.steady()),
      link_(std::move(open), options_.clock, period_ms(options_.rate_hz)),
      driving_(options_.cmd_vel_timeout, options_.velocities_after_stop),
      odometry_(options_.errors),
      parameters_([this] { return link_.session(); }, [this] { return driving_.armed(); },
                  fixed_parameters(options_, names_),
                  [this](RobotSession& session) {
                    odometry_.note_parameters(session);
                    describe_robot(session);
                  },
                  [this](const Error& why) { lose(why); }),
      publications_(middlewares_, names_),
      requests_(middlewares_, names_,
                {link_, driving_, odometry_, [this] { return moment(); },
                 [this](const Error& why) { lose(why); }, options_.words, options_.notice}) {
  for (Middleware* each : middlewares_) each->serve_parameters(parameters_);
}

void Driver::step(microseconds most) {
  const microseconds asked = utc_.steady();
  for (Middleware* each : middlewares_) each->poll();
  polled_ = asked;
  try {
    if (link_.seek()) begin(*link_.session());
    if (RobotSession* session = link_.session())
      attend(*session, std::min(most, driving_.armed() ? kTick : kIdle));
    else if (!middlewares_.empty())
      middlewares_.front()->wait(most);
  } catch (const Error& error) {
    lose(error);
  }
  report();
}

void Driver::run(const std::function<bool()>& goes_on) {
  try {
    while (goes_on()) step();
  } catch (...) {
    try {
      end();
    } catch (const Error& error) {
      options_.notice(options_.words(error));
    }
    throw;
  }
  end();
}

void Driver::begin(RobotSession& session) {
  newest_.reset();
  driving_.begin(session);
  odometry_.begin(session, std::exchange(restarted_, false));
  describe_robot(session);
}

void Driver::describe_robot(RobotSession& session) {
  model_ = RobotModel(session.numbers());
  const std::int64_t now_ns = utc_.now_ns();
  if (model_.complete())
    publications_.robot_description.publish({model_.urdf(names_.prefix(), true)}, now_ns);
  publications_.tf_static.publish(fixed_transforms(now_ns, names_), now_ns);
}

void Driver::attend(RobotSession& session, microseconds most) {
  driving_.step(session, utc_.steady());
  session.pump(most);
  if (session.restarted()) throw robot::LinkLost("the robot has restarted");
  if (session.take_fault()) driving_.release();
  while (const auto telemetry = session.take_sample()) take(session, *telemetry);
  session.keep_telemetry();
}

void Driver::take(RobotSession& session, const protocol::Telemetry& telemetry) {
  newest_ = telemetry;
  const auto at = session.client().clock().to_host(telemetry.device_time_us);
  if (!at) return;  // no round trip has shown yet when that was
  const std::int64_t now_ns = utc_.now_ns();
  const std::int64_t time_ns = std::min(utc_.utc_ns(at->us), now_ns);
  if (at->us * 1000 - battery_ns_ >= kSecond_ns) {
    battery_ns_ = at->us * 1000;
    publications_.battery_state.publish(battery(time_ns, 1e-3 * telemetry.battery.mv, names_), time_ns);
  }
  // The clock's map is corrected with every round trip, and a stamp that goes back a little would be two poses at one time. A
  // stamp that goes back far follows the system's clock, which was set back.
  const bool goes_back = time_ns <= published_ns_ && time_ns > published_ns_ - kSecond_ns / 10;
  if (!goes_back && odometry_.take(session, telemetry)) publish(telemetry, time_ns);
}

void Driver::publish(const protocol::Telemetry& telemetry, std::int64_t time_ns) {
  published_ns_ = time_ns;
  const OdometryTrack& track = odometry_.track();
  const recording::OdometrySample& sample = odometry_.sample();
  const BaseState state{time_ns,
                        sample,
                        track.covariance(),
                        twist_covariance(sample.v_mps, sample.omega_radps, 1e-3 * period_ms(options_.rate_hz),
                                         track.geometry(), track.errors()),
                        track.left_counts(),
                        track.right_counts()};
  publications_.odometry.publish(odometry(state, names_), time_ns);
  if (publications_.tf.wanted()) publications_.tf.publish(transforms(state, model_, names_), time_ns);
  if (model_.complete() && publications_.joint_states.wanted())
    publications_.joint_states.publish(joints(state, telemetry, model_, track.geometry().factors), time_ns);
  if (publications_.telemetry.wanted())
    publications_.telemetry.publish(ros2::telemetry(state, telemetry, names_), time_ns);
}

void Driver::lose(const Error& why) {
  if (RobotSession* session = link_.session()) {
    restarted_ = restarted_ || session->restarted();
    link_.lose(why);
  }
  newest_.reset();
  driving_.lose();
}

std::optional<std::int64_t> Driver::utc_of_robot_ns(std::int64_t device_time_us) {
  RobotSession* session = link_.session();
  if (session == nullptr) return std::nullopt;
  const auto at = session->client().clock().to_host(static_cast<std::uint64_t>(device_time_us));
  if (!at) return std::nullopt;
  return utc_.utc_ns(at->us);
}

void Driver::end() {
  RobotSession* session = link_.session();
  if (session == nullptr || !driving_.armed()) return;
  bool rests = false;
  try {
    driving_.stop(*session);
    rests = robot::wait_until_power_off(session->client());
  } catch (const Error&) {  // then it is disarmed all the same
  }
  driving_.disarm(*session);
  if (!rests) throw Error("the robot did not come to rest and was disarmed: it may roll on");
}

DriverState Driver::state() {
  DriverState state;
  state.time_ns = utc_.now_ns();
  state.now = utc_.steady();
  state.node = options_.node;
  state.robot = link_.robot();
  state.losses = link_.losses();
  state.commands = driving_.counts();
  state.velocities_ignored = driving_.why_ignored();
  state.odometry_event = odometry_.event();
  state.refused_pose = odometry_.refused_pose();
  RobotSession* session = link_.session();
  if (session == nullptr) {
    state.why_no_robot = options_.words(link_.why());
    return state;
  }
  state.other_factors =
      options_.calibrated && !same(*options_.calibrated, odometry_.track().geometry().factors);
  const robot::Client& client = session->client();
  state.port = client.name();
  state.telemetry = newest_;
  state.telemetry_age = session->telemetry_age();
  state.counts = client.counts();
  state.frames = client.frames();
  state.clock_drift = client.clock().drift();
  if (const auto at = client.clock().to_host(client.device_time_us()))
    state.stamp_bound_s = 1e-6 * at->bound_us;
  return state;
}

void Driver::note_link(const std::string& sentence) {
  if (std::exchange(noticed_, sentence) != sentence) options_.notice(sentence);
}

void Driver::report() {
  constexpr std::int64_t kBetweenLooks_ns = 20'000'000;  // a hundredth of the work, and nobody reads faster
  const std::int64_t look_ns = utc_.steady().count() * 1000;
  if (look_ns - looked_ns_ < kBetweenLooks_ns) return;
  looked_ns_ = look_ns;
  const DriverState state = this->state();
  note_link(state.why_no_robot.empty() ? "connected to the robot at " + state.port : state.why_no_robot);
  msg::DiagnosticArray now = diagnostics(state, options_.fault_help);
  // A sentence may hold a figure that changes all the time, as the age of a stamp.
  const std::int64_t since_ns = look_ns - reported_ns_;
  if (since_ns < kSecond_ns / 5 || (since_ns < kSecond_ns && !says_more(now, reported_))) return;
  reported_ns_ = look_ns;
  publications_.diagnostics.publish(now, msg::nanoseconds(now.header.stamp));
  reported_ = std::move(now);
}

}  // namespace astro::ros2
