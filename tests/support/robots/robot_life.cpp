#include "tests/support/robots/robot_life.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/protocol/frame.hpp"
#include "common/protocol/messages.hpp"
#include "host/simulation/robot/virtual_robot.hpp"
#include "tests/support/robots/drive_of.hpp"
#include "tests/support/robots/halt_witness.hpp"
#include "tests/support/robots/random.hpp"

namespace astro::support {
namespace {

using protocol::Mode;

constexpr int kSilence_ms = 3000;
constexpr int kUsualTimeout_ms = 200;

// ---- the robot's construction

sim::Wiring random_wiring(Random& random) {
  sim::Wiring wiring;
  for (bool* one : {&wiring.left_motor_reversed, &wiring.right_motor_reversed, &wiring.motors_swapped,
                    &wiring.left_encoder_reversed, &wiring.right_encoder_reversed, &wiring.encoders_swapped,
                    &wiring.left_motor_dead, &wiring.right_motor_dead, &wiring.left_encoder_dead,
                    &wiring.right_encoder_dead, &wiring.left_channel_lost, &wiring.right_channel_lost})
    *one = random.chance(0.06);
  if (random.chance(0.15)) wiring.left_motor_reversed = wiring.right_motor_reversed = true;
  if (random.chance(0.1)) wiring.left_encoder_reversed = wiring.right_encoder_reversed = true;
  return wiring;
}

sim::Config random_robot(Random& random, std::uint64_t seed) {
  sim::Config config;
  config.seed = seed;
  config.true_ed = random.uniform(0.9, 1.1);
  config.scale = random.uniform(0.5, 2);
  config.motor_mismatch = random.uniform(-0.3, 0.3);
  config.body_kg = random.uniform(0.5, 30);
  config.on_stand = random.chance(0.2);
  config.supply_V = random.chance(0.7) ? 12 : random.uniform(5, 25);
  if (random.chance(0.7)) config.wiring = random_wiring(random);
  return config;
}

// ---- its parameters

std::int32_t random_value(Random& random, const ParamRow& row) {
  switch (random.between(0, 5)) {
    case 0:
      return row.minimum_raw;
    case 1:
      return row.maximum_raw;
    case 2: {  // any magnitude
      const double low = std::max(1.0, std::abs(static_cast<double>(row.minimum_raw)));
      const double value =
          std::exp(random.uniform(std::log(low), std::log(std::max(low, double(row.maximum_raw)))));
      return static_cast<std::int32_t>(std::clamp<double>(value, row.minimum_raw, row.maximum_raw));
    }
    case 3: {  // wrong by a factor
      const double value = row.default_raw * random.uniform(0.02, 50);
      return static_cast<std::int32_t>(std::clamp<double>(value, row.minimum_raw, row.maximum_raw));
    }
    default:
      return static_cast<std::int32_t>(random.between(row.minimum_raw, row.maximum_raw));
  }
}

ParameterSet random_set(Random& random) {
  ParameterSet set = ParameterSet::defaults();
  const double changed = std::array{0.0, 0.05, 0.2, 1.0}[static_cast<std::size_t>(random.between(0, 3))];
  for (const ParamRow& row : kParamTable) {
    if (row.kind == ParamKind::text || !random.chance(changed)) continue;
    set.set(row.id, random_value(random, row));
  }
  // Half of the robots keep the default time-out, which decides what must hold for them.
  if (random.chance(0.5)) set.set(Param::command_timeout, kUsualTimeout_ms);
  if (random.chance(0.3)) {  // gains that are too small to hold a load
    set.set(Param::kp, static_cast<std::int32_t>(random.between(0, 20 << 16)));
    set.set(Param::ki, 0);
  }
  for (const Param polarity : {Param::motor_polarity_left, Param::motor_polarity_right,
                               Param::encoder_polarity_left, Param::encoder_polarity_right})
    set.set(polarity, random.chance(0.1) ? -1 : 1);
  // Changes a set that the robot would refuse, parameter by parameter, until the robot accepts it.
  for (auto verdict = validate(set); !verdict; verdict = validate(set)) {
    const Param bad = verdict.error();
    if (set.get(bad) == ParameterSet::defaults().get(bad)) return ParameterSet::defaults();
    set.set(bad, ParameterSet::defaults().get(bad));
  }
  return set;
}

// ---- its life

class Life {
 public:
  explicit Life(std::uint64_t seed) : random_(seed), robot_(random_robot(random_, seed), {}) {}

  LifeReport run() {
    pass(60);  // through boot
    enter_parameters();
    const auto acts = random_.between(10, 40);
    for (std::int64_t i = 0; i < acts && report_.violation.empty(); ++i) act();
    fall_silent(kSilence_ms + 2000);
    return report_;
  }

 private:
  // ---- hosts

  template <protocol::Message M>
  void send(const M& message, int port) {
    request_id_ = static_cast<std::uint16_t>(request_id_ % 0x7FFF + 1);
    // Some requests come from an onlooker at that port.
    const bool onlooker = random_.chance(0.1);
    const auto id = static_cast<std::uint16_t>(request_id_ | (onlooker ? protocol::kOnlookerBit : 0));
    robot_.board().ports().host_write(port, protocol::Frame(message, id).bytes());
    asked_ = {port, onlooker};
    asked_id_ = id;
    asked_message_ = M::kId;
    silent_ms_ = 0;
    step();
  }
  int any_port() { return random_.chance(0.8) ? port_ : 1 - port_; }

  void enter_parameters() {
    const ParameterSet set = random_set(random_);
    send(protocol::Hello{protocol::kProtocolVersion}, 0);
    send(protocol::RevertParameters{}, 0);
    for (const ParamRow& row : kParamTable) {
      if (row.kind == ParamKind::text) continue;
      send(protocol::StageParameter{static_cast<std::uint16_t>(row.id), set.get(row.id), {}}, 0);
    }
    send(protocol::CommitParameters{}, 0);
    pass(5);
    if (!(robot_.robot().parameters() == set)) report_.violation = "a legal set was not taken";
  }

  void arm() {
    send(protocol::ClearFaults{}, port_);
    arm_asked_ = true;
    send(protocol::Arm{}, port_);
  }

  /// A host that drives by velocities for a random time.
  void velocities() {
    const auto v = static_cast<std::int32_t>(random_.between(-2'000'000, 2'000'000));
    const auto omega = static_cast<std::int32_t>(random_.between(-5'000'000, 5'000'000));
    const auto repeats = random_.chance(0.3) ? 1 : random_.between(1, 40);
    for (std::int64_t i = 0; i < repeats; ++i) {
      send(protocol::Velocity{v, omega}, port_);
      pass(static_cast<int>(random_.between(1, 60)));
      // Somebody at either port halts the robot, and this host goes on as if nothing had happened.
      if (random_.chance(0.03)) halt(any_port());
    }
  }

  void halt(int port) {
    switch (random_.between(0, 3)) {
      case 0:
        return send(protocol::Stop{}, port);
      case 1:
        return send(protocol::Pause{}, port);
      case 2:
        return send(protocol::Disarm{}, port);
      default:
        return send(protocol::EmergencyStop{}, port);
    }
  }

  void segments() {
    const auto count = random_.between(1, 4);
    for (std::int64_t i = 0; i < count; ++i) {
      protocol::AddSegment segment;
      segment.kind = static_cast<protocol::SegmentKind>(random_.between(0, 3));
      using enum protocol::SegmentKind;
      if (segment.kind == line || segment.kind == arc)
        segment.length_nm = random_.between(-2'000'000'000, 2'000'000'000);
      if (segment.kind == spin || segment.kind == arc)
        segment.angle = random_.between(-(std::int64_t{2} << 32), std::int64_t{2} << 32);
      if (segment.kind == protocol::SegmentKind::stop)
        segment.dwell_ms = static_cast<std::uint32_t>(random_.between(1, 5000));
      segment.tag = static_cast<std::uint16_t>(i + 1);
      send(segment, port_);
    }
    stay(static_cast<int>(random_.between(1, 3000)));
  }

  void voltages() {
    const auto repeats = random_.between(1, 20);
    for (std::int64_t i = 0; i < repeats; ++i) {
      send(protocol::WheelVoltage{static_cast<std::int32_t>(random_.between(-12'000, 12'000)),
                                  static_cast<std::int32_t>(random_.between(-12'000, 12'000))},
           port_);
      pass(static_cast<int>(random_.between(1, 100)));
    }
  }

  /// A host that only sends pings.
  void stay(int ms) {
    for (int passed = 0; passed < ms; passed += 50) {
      send(protocol::Ping{}, port_);
      pass(49);
    }
  }

  void change_gains() {
    const ParameterSet& active = robot_.robot().parameters();
    send(protocol::RevertParameters{}, port_);
    for (const Param gain : {Param::kp, Param::ki, Param::kV_left, Param::kV_right, Param::k_sync,
                             Param::observer_bandwidth, Param::path_k_along, Param::path_k_cross}) {
      const std::int32_t value =
          random_.chance(0.4) ? random_value(random_, param_row(gain)) : active.get(gain);
      send(protocol::StageParameter{static_cast<std::uint16_t>(gain), value, {}}, port_);
    }
    send(protocol::ApplyParameters{}, port_);
  }

  void the_world_changes() {
    sim::Board& board = robot_.board();
    switch (random_.between(0, 7)) {
      case 0:
      case 1: {  // a slope, which pulls at both wheels alike
        const double slope_Nm = random_.uniform(-1.5, 1.5);
        for (const Side side : {Side::left, Side::right}) board.set_load(side, {.torque_Nm = slope_Nm});
        break;
      }
      case 2:
        board.set_load(random_.chance(0.5) ? Side::left : Side::right,
                       {.torque_Nm = random_.uniform(-1, 1), .drag_Nm = random_.chance(0.5) ? 100.0 : 0.2});
        break;
      case 3:
        for (const Side side : {Side::left, Side::right}) board.set_load(side, {});
        break;
      case 4:
        board.battery().set_open_circuit_V(random_.uniform(6, 20));
        break;
      case 5:
        board.encoders().lose_channel(random_.chance(0.5) ? Side::left : Side::right);
        break;
      case 6:
        board.motors().disconnect(random_.chance(0.5) ? Side::left : Side::right);
        break;
      default: {
        const hal::EncoderCounts now = board.encoders().read();
        board.encoders().preset(
            {now.left + static_cast<std::int32_t>(random_.between(-2000, 2000)), now.right});
      }
    }
  }

  void act() {
    switch (random_.between(0, 19)) {
      case 0:
      case 1:
      case 2:
        return arm();
      case 3:
      case 4:
      case 5:
        if (!drive_of(robot_).armed()) arm();
        return velocities();
      case 6:
      case 7:
        if (!drive_of(robot_).armed()) arm();
        return segments();
      case 8:
        if (!drive_of(robot_).armed()) arm();
        return voltages();
      case 9:
      case 10:
        return send(protocol::Stop{}, any_port());
      case 11:
        return send(protocol::Pause{}, any_port());
      case 12:
        return random_.chance(0.8) ? send(protocol::Resume{}, any_port())
                                   : send(protocol::Rest{}, any_port());
      case 13:
        return random_.chance(0.5) ? send(protocol::Disarm{}, any_port())
                                   : send(protocol::EmergencyStop{}, any_port());
      case 14:
        port_ = 1 - port_;  // another program takes over
        return send(protocol::Hello{protocol::kProtocolVersion}, port_);
      case 15:
        return send(protocol::Hello{protocol::kProtocolVersion}, any_port());
      case 16:
        return change_gains();
      case 17:
        return the_world_changes();
      case 18:
        return fall_silent(static_cast<int>(random_.between(1, 1500)));
      default:
        return fall_silent(kSilence_ms + static_cast<int>(random_.between(0, 1500)));
    }
  }

  void fall_silent(int ms) {
    if (ms >= kSilence_ms) {
      ++report_.silences;
      report_.silences_that_began_with_power += powered() ? 1 : 0;
    }
    pass(ms);
  }

  // ---- time

  void pass(int ms) {
    for (int i = 0; i < ms && report_.violation.empty(); ++i) step();
  }

  bool powered() { return robot_.board().motors().state() == sim::Bridge::drive; }

  void step() {
    robot_.step();
    for (int port = 0; port < sim::Ports::kPorts; ++port) read(port);
    ++report_.ticks;
    report_.powered_ticks += powered() ? 1 : 0;
    report_.faults_seen |= drive_of(robot_).faults().mask();
    look();
  }

  void read(int port) {
    std::array<std::uint8_t, 512> bytes{};
    for (std::size_t count = bytes.size(); count == bytes.size();) {
      count = robot_.board().ports().host_read(port, bytes);
      for (std::size_t i = 0; i < count; ++i)
        if (const auto body = framers_[static_cast<std::size_t>(port)].push(bytes[i])) take(port, *body);
    }
  }

  void take(int port, std::span<const std::uint8_t> body) {
    const std::uint16_t id = protocol::peek(body)->request_id;
    if (port != asked_.port || id == 0 || id != asked_id_) return;  // an event has the id 0
    const bool taken = body.front() != protocol::ErrorReply::kId;
    report_.refused_after_halt +=
        witness_.halted() && !taken && HaltWitness::is_motion(asked_message_) ? 1 : 0;
    witness_.answered(asked_, asked_message_, taken);
    asked_id_ = 0;
  }

  void look() {
    const Drive& drive = drive_of(robot_);
    witness_.look(drive, robot_.robot().parameters());
    if (!witness_.violation().empty()) return violate(witness_.violation().c_str());
    const Mode mode = drive.mode();
    ++silent_ms_;
    stopping_silent_ms_ = mode == Mode::stopping ? std::min(stopping_silent_ms_ + 1, silent_ms_) : 0;
    if (powered() && !drive.armed()) return violate("power without being armed");
    if (drive.armed() && !was_armed_ && !arm_asked_) return violate("armed by itself");
    was_armed_ = drive.armed();
    if (!drive.armed()) arm_asked_ = false;
    if (stopping_silent_ms_ > kSilence_ms) return violate("three seconds of silence in a ramp, and power");

    const int timeout_ms = robot_.robot().parameters().get(Param::command_timeout);
    if (timeout_ms == 0) return;  // the robot may drive, or stay armed, without end
    const int longer_ms = std::max(0, timeout_ms - kUsualTimeout_ms);
    if (silent_ms_ > kSilence_ms + longer_ms && powered()) return violate("silence, and power");
    if (silent_ms_ > kSilence_ms + longer_ms && robot_.board().motors().state() != sim::Bridge::coast)
      return violate("silence, and the bridges are not open");
  }

  void violate(const char* what) {
    const Drive& drive = drive_of(robot_);
    report_.violation = std::string(what) + ": mode " + std::string(protocol::name(drive.mode())) + ", " +
                        std::to_string(silent_ms_) + " ms after the last byte, faults " +
                        std::to_string(drive.faults().mask()) + ", tick " + std::to_string(report_.ticks);
  }

  Random random_;
  simulation::VirtualRobot robot_;
  LifeReport report_;
  int port_ = 0;
  std::uint16_t request_id_ = 0;
  HaltWitness::Host asked_;  // who sent the last request, which has no answer yet unless its id is 0
  std::uint16_t asked_id_ = 0;
  std::uint8_t asked_message_ = 0;
  std::array<protocol::Framer, sim::Ports::kPorts> framers_;
  HaltWitness witness_;
  int silent_ms_ = 0, stopping_silent_ms_ = 0;
  bool arm_asked_ = false, was_armed_ = false;
};

}  // namespace

LifeReport live(std::uint64_t seed) { return Life(seed).run(); }

}  // namespace astro::support
