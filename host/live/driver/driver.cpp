#include "host/live/driver/driver.hpp"

#include <algorithm>
#include <cmath>

#include "host/formats/cdr/codec.hpp"
#include "host/formats/messages/ros_messages.hpp"
#include "host/formats/messages/std.hpp"
#include "host/robot/motion/rest.hpp"

namespace astro::live {

using std::chrono::milliseconds;

namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;
// The longest sleep of a step. While the robot is armed it is one control tick, so that no velocity waits longer. Otherwise
// only services wait, so a longer sleep saves processor time.
constexpr microseconds kTick = milliseconds(1), kIdle = milliseconds(5);
/// The longest time for which a step reads parameters, because a stop has to wait for the end of the step.
constexpr microseconds kShareOfTable = milliseconds(5);

/// The same state with the gyro's pose, and with its rate while it counts.
BaseState with_gyro(BaseState state, const recording::GyroPose& gyro, const OdometryTrack& track,
                    bool counts) {
  recording::OdometrySample& sample = state.sample;
  state.time_ns -= 1000 * (sample.time_us - gyro.time_us);
  state.covariance = track.gyro_covariance();
  sample.x_m = gyro.x_m;
  sample.y_m = gyro.y_m;
  sample.theta_rad = gyro.theta_rad;
  if (!counts) return state;
  sample.omega_radps = gyro.omega_radps;
  state.twist.vw = 0;
  state.twist.ww = gyro_rate_variance(gyro.omega_radps, track.geometry().gyro);
  return state;
}

std::uint16_t period_ms(double rate_hz) {
  return static_cast<std::uint16_t>(std::clamp(std::lround(1000 / rate_hz), 1L, 60'000L));
}

}  // namespace

Driver::Driver(std::vector<Middleware*> middlewares, OpenPort open, DriverOptions options)
    : middlewares_(std::move(middlewares)),
      options_(std::move(options)),
      names_(options_.node_namespace, options_.names),
      utc_(options_.clock),
      polled_(utc_.steady()),
      link_(std::move(open), options_.clock, {period_ms(options_.rate_hz), protocol::Telemetry::kAll}),
      driving_(options_.cmd_vel_timeout, options_.velocities_after_stop),
      odometry_(options_.errors),
      parameters_([this] { return link_.session(); }, [this] { return driving_.armed(); }, own_parameters(),
                  [this] {
                    for (Middleware* each : middlewares_) each->poll_urgent();
                  },
                  [this](RobotSession& session) {
                    odometry_.note_parameters(session);
                    describe_robot(session);
                  },
                  [this](const Error& why) { lose(why); }, options_.words),
      publications_(middlewares_, names_),
      requests_(middlewares_, names_, options_.cmd_vel_type,
                {link_, driving_, odometry_, [this] { return moment(); },
                 [this](const Error& why) { lose(why); }, options_.words, options_.notice}) {
  for (Middleware* each : middlewares_) each->serve_parameters(parameters_);
  use_sim_time(options_.use_sim_time);
}

/// All but `use_sim_time` repeat the options and cannot be set.
std::vector<OwnParameter> Driver::own_parameters() {
  return {
      {"odom_frame_id", "frame of odometry", to_parameter(names_.odom_frame())},
      {"base_frame_id", "frame of the robot, on the floor between its wheels",
       to_parameter(names_.base_frame())},
      {"enable_odom_tf", "whether /tf has the robot in the frame of odometry", to_flag(options_.odom_tf)},
      {"publish_rate", "messages of odometry a second [Hz]",
       to_parameter(1000.0 / period_ms(options_.rate_hz))},
      {"cmd_vel_timeout", "how long a velocity holds [s]",
       to_parameter(1e-6 * static_cast<double>(options_.cmd_vel_timeout.count()))},
      {"cmd_vel_after_stop", "whether velocities drive the robot again after this node's stop, without arm",
       to_flag(options_.velocities_after_stop)},
      {"cmd_vel_type", "as what velocities are taken: TwistStamped, Twist or both",
       to_parameter(std::string(name(options_.cmd_vel_type)))},
      {"use_sim_time", "whether stamps are the time of /clock", to_flag(options_.use_sim_time),
       [this](const ros2::msg::ParameterValue& value) { use_sim_time(value.bool_value); }}};
}

void Driver::use_sim_time(bool on) {
  utc_.simulate(on);
  if (!on || std::exchange(hears_clock_, true)) return;
  for (Middleware* each : middlewares_)
    each->subscribe({names_.absolute("/clock"), message_type<ros2::msg::Clock>(), false, false, 1},
                    [this](ByteView bytes) {
                      if (const auto told = ros2::decode<ros2::msg::Clock>(bytes))
                        utc_.tell(ros2::msg::nanoseconds(told->clock));
                    });
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
  if (session.stop_left_drive())
    options_.notice("the robot drove, and no program here drives it: it was stopped");
}

/// Reads some of the parameters that are not known yet or that somebody has asked for again. False if none is left to be
/// read.
bool Driver::read_on(RobotSession& session) {
  const microseconds most = driving_.armed() ? kTick : kShareOfTable;
  if (session.knows_parameters()) return parameters_.step(session, most);
  if (session.read_parameters(most)) begin_odometry(session);
  return true;
}

void Driver::begin_odometry(RobotSession& session) {
  parameters_.begin(session.client().now());
  odometry_.begin(session, std::exchange(restarted_, false));
  describe_robot(session);
  if (std::exchange(set_up_, true)) return;
  if (const std::string why = parameters_.put_at_start(options_.robot_parameters); !why.empty())
    options_.notice("the robot's parameters were not set: " + why);
}

void Driver::describe_robot(RobotSession& session) {
  model_ = ros2::RobotModel(session.numbers());
  const std::int64_t now_ns = utc_.now_ns();
  if (model_.complete())
    publications_.robot_description.publish({model_.urdf(names_.prefix(), names_.base_frame())}, now_ns);
  if (const ros2::msg::TFMessage fixed = fixed_transforms(now_ns, names_); !fixed.transforms.empty())
    publications_.tf_static.publish(fixed, now_ns);
}

void Driver::attend(RobotSession& session, microseconds most) {
  driving_.step(session, utc_.steady());
  const bool reads = read_on(session);
  if (link_.session() != &session) return;  // lost while its parameters were set
  session.pump(reads ? microseconds::zero() : most);
  if (session.restarted()) throw robot::LinkLost("the robot has restarted");
  if (session.take_fault()) driving_.release();
  while (const auto telemetry = session.take_sample()) take(session, *telemetry);
  session.keep_telemetry();
}

void Driver::take(RobotSession& session, const protocol::Telemetry& telemetry) {
  newest_ = telemetry;
  if (!utc_.known() || !session.knows_parameters()) return;
  const auto at = session.client().clock().to_host(telemetry.device_time_us);
  if (!at) return;  // no round trip has measured the clock offset yet
  const std::int64_t time_ns = std::min(utc_.utc_ns(at->us), utc_.now_ns());
  if (at->us * 1000 - battery_ns_ >= kSecond_ns) {
    battery_ns_ = at->us * 1000;
    publications_.battery_state.publish(battery(time_ns, 1e-3 * telemetry.battery.mv, names_), time_ns);
  }
  // Every round trip corrects the clock offset, so a stamp can be a little older than the one before. That sample is left
  // out, because it would be a second pose for the same time. If a stamp is much older, the system's clock was set back, and
  // the sample is published.
  const bool goes_back = time_ns <= published_ns_ && time_ns > published_ns_ - kSecond_ns / 10;
  if (odometry_.take(session, telemetry) && !goes_back) publish(telemetry, time_ns);
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
  if (const auto gyro = gyro_poses_.next(telemetry); gyro && publications_.odometry_with_gyro.wanted()) {
    const bool counts = telemetry.fused.gyro == protocol::GyroState::running;
    publications_.odometry_with_gyro.publish(odometry(with_gyro(state, *gyro, track, counts), names_),
                                             time_ns);
  }
  if (publications_.tf.wanted())
    publications_.tf.publish(transforms(state, model_, names_, options_.odom_tf), time_ns);
  if (model_.complete() && publications_.joint_states.wanted())
    publications_.joint_states.publish(joints(state, telemetry, model_, track.geometry().factors), time_ns);
  if (publications_.telemetry.wanted())
    publications_.telemetry.publish(live::telemetry(state, telemetry, names_), time_ns);
}

void Driver::lose(const Error& why) {
  if (RobotSession* session = link_.session()) {
    restarted_ = restarted_ || session->restarted();
    link_.lose(why);
  }
  newest_.reset();
  driving_.release();
}

std::optional<std::int64_t> Driver::utc_of_robot_ns(std::int64_t device_time_us) {
  RobotSession* session = link_.session();
  if (session == nullptr || !utc_.known()) return std::nullopt;
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
  state.other_factors = options_.calibrated && session->knows_parameters() &&
                        !same(*options_.calibrated, odometry_.track().geometry().factors);
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
  constexpr std::int64_t kBetweenLooks_ns = 20'000'000;  // more often is no use: nobody reads faster
  const std::int64_t look_ns = utc_.steady().count() * 1000;
  if (look_ns - looked_ns_ < kBetweenLooks_ns) return;
  looked_ns_ = look_ns;
  const DriverState state = this->state();
  note_link(state.why_no_robot.empty() ? "connected to the robot at " + state.port : state.why_no_robot);
  ros2::msg::DiagnosticArray now = diagnostics(state, options_.fault_help);
  // A message may hold a number that changes all the time, such as the age of a stamp. So a change is published after 0.2 s
  // at the earliest.
  const std::int64_t since_ns = look_ns - reported_ns_;
  if (since_ns < kSecond_ns / 5 || (since_ns < kSecond_ns && !says_more(now, reported_))) return;
  reported_ns_ = look_ns;
  publications_.diagnostics.publish(now, ros2::msg::nanoseconds(now.header.stamp));
  reported_ = std::move(now);
}

}  // namespace astro::live
