#include "host/wall/touch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "host/base/text/degrees.hpp"

namespace astro::wall {
namespace {

using namespace std::chrono_literals;

constexpr std::uint64_t kStep_us = 20'000;  // between voltages, a tenth of the robot's time-out
constexpr double kStep_s = 1e-6 * kStep_us;
constexpr double kStands_mps = 0.003;  // as the firmware's own limit for a stopped wheel
constexpr double kStands_s = 0.1;      // a wheel that stands for so long is at the wall
constexpr double kStarted_m = 0.001;   // a wheel that has rolled so far turns
constexpr double kSettled_s = 0.15;    // both wheels stand under the full push for so long
constexpr double kSame_m = 0.0005;     // two pushes that end so close ended at the same place
constexpr int kMostPushes = 20;
constexpr double kBackwards_m = 0.005;  // more than play, or a rotor that settles
constexpr double kRunsAway_mps = 1.5 * kCreep_mps;
constexpr double kBack_m = 0.05;       // of both wheels: nothing pushes it back so far
constexpr double kMostTurn_rad = 0.8;  // by eye, or back from laps by a rough wheelbase, it turns less
constexpr double kPushing_s = 30;      // besides the way there
constexpr double kSpeedGain_Vspm = 10, kIntegral_Vpm = 150;
constexpr double kIntegralAtWall_Vpm = 500;  // there is nothing to overshoot, and time is short

/// For how long each wheel has stood although its motor had voltage; left, right. A wheel stands if it moves by less than 2.5
/// counts in a tenth of a second; a wheel slower than 1 mm/s cannot make more. The measured speed is not used, because with a
/// count now and then the wheel looks as if it turned.
class StallClock {
 public:
  explicit StallClock(double count_m) : still_m_(2.5 * count_m) {}

  /// Takes each sample of telemetry, in order.
  void look(const WheelMoment& moment, const WheelTravel& travel) {
    const double step_s = last_us_ == 0 ? 0 : 1e-6 * static_cast<double>(moment.time_us - last_us_);
    last_us_ = moment.time_us;
    note(0, moment.voltage_V[0], travel.left_m, step_s);
    note(1, moment.voltage_V[1], travel.right_m, step_s);
  }

  double stood_s(std::size_t side) const { return stood_s_[side]; }
  double longest_s() const { return stood_s_[0] > stood_s_[1] ? stood_s_[0] : stood_s_[1]; }

 private:
  static constexpr std::size_t kSamples = 10;  // of 10 ms
  static constexpr double kVoltage_V = 0.05;   // less is none

  void note(std::size_t side, double voltage_V, double at_m, double step_s) {
    std::array<double, kSamples>& was_at_m = was_at_m_[side];
    const double moved_m = at_m - was_at_m[next_ % kSamples];
    was_at_m[next_ % kSamples] = at_m;
    if (side == 1) ++next_;
    const bool stands = voltage_V > kVoltage_V && moved_m < still_m_ && moved_m > -still_m_;
    stood_s_[side] = stands ? stood_s_[side] + step_s : 0;
  }

  double still_m_;
  std::uint64_t last_us_ = 0;
  std::size_t next_ = 0;
  std::array<std::array<double, kSamples>, 2> was_at_m_{};
  std::array<double, 2> stood_s_{};
};

class Square {
 public:
  Square(robot::DriveSession& session, WheelWatch& watch, robot::Client& client, const WallRobot& robot,
         double push_V)
      : session_(session),
        watch_(watch),
        client_(client),
        robot_(robot),
        push_V_(push_V),
        start_(watch.travel()),
        stall_(robot.count_m) {
    watch_.seen = [this](const WheelMoment& moment) { stall_.look(moment, watch_.travel()); };
  }
  ~Square() {
    watch_.seen = [](const WheelMoment&) {};
  }
  Square(const Square&) = delete;
  Square& operator=(const Square&) = delete;

  Touch run(double within_m) {
    time_s_ = kPushing_s + within_m / kCreep_mps;
    end_us_ = watch_.now().time_us + static_cast<std::uint64_t>(1e6 * time_s_);
    WheelTravel before = start_;
    while (touch_.pushes < kMostPushes) {
      const bool settled = push(within_m);
      if (touch_.pushes == 1) require_started();
      const WheelTravel moved = watch_.travel() - before;
      before = watch_.travel();
      const bool same = std::max(std::abs(moved.right_m), std::abs(moved.left_m)) < kSame_m;
      if (settled && same) return finish();
    }
    throw NotFlush(
        fmt::format("the robot was still moving after {} pushes against the wall: see that the wall is "
                    "straight and firm, the front of the robot flat, and the floor free and clean",
                    kMostPushes));
  }

 private:
  using Wheels = std::array<double, 2>;

  double crept_m() const {
    const WheelTravel since = watch_.travel() - start_;
    return (since.right_m + since.left_m) / 2;
  }

  /// Applies the voltages for one step. False as soon as a wheel has stood under voltage for long enough. All samples that have
  /// come are read first: if a simulator runs ahead of its host, they make the client send its heartbeat before the voltage,
  /// and not between two voltages.
  bool apply(const Wheels& voltage_V) {
    client_.pump(0us);
    const std::uint64_t from_us = watch_.now().time_us, next_us = from_us + kStep_us;
    session_.set_wheel_voltages(voltage_V[0], voltage_V[1]);
    client_.pump_until([&] { return watch_.now().time_us >= next_us; }, 60ms);
    if (watch_.now().time_us == from_us) require_telemetry(from_us);
    step_s_ = 1e-6 * static_cast<double>(watch_.now().time_us - from_us);
    touch_.longest_stall_s = std::max(touch_.longest_stall_s, stall_.longest_s());
    return stall_.longest_s() < kStall_s - kStep_s;
  }

  /// Without telemetry nobody knows what the robot does. So its voltage is not renewed, and soon it is taken
  /// away.
  void require_telemetry(std::uint64_t from_us) {
    if (client_.pump_until([&] { return watch_.now().time_us > from_us; }, 240ms)) return;
    session_.set_wheel_voltages(0, 0);
    throw robot::LinkLost(client_.name() + " sends no more telemetry while it pushes against the wall");
  }

  /// Regulates each wheel to the creeping speed, as far as the push allows. A wheel that stands under voltage while the other
  /// one turns is on the side that touches, so it rests until the other one has come up. Otherwise it would be stalled all that
  /// time. If the robot turned about its corner, it would also be turned back, and its friction would add to the force on the
  /// wall.
  Wheels regulate() {
    choose_rest();
    const double integral_Vpm = touch_.pushes > 1 ? kIntegralAtWall_Vpm : kIntegral_Vpm;
    Wheels voltage_V{};
    for (std::size_t side = 0; side < 2; ++side) {
      if (rests_[side]) {
        integral_V_[side] = 0;
        continue;
      }
      const double missing_mps = kCreep_mps - watch_.now().speed_mps[side];
      const double known_V = robot_.kS_V[side] + robot_.kV_Vspm[side] * kCreep_mps;
      integral_V_[side] =
          std::clamp(integral_V_[side] + integral_Vpm * missing_mps * step_s_, -known_V, push_V_);
      voltage_V[side] = std::clamp(known_V + kSpeedGain_Vspm * missing_mps + integral_V_[side], 0.0, push_V_);
    }
    return voltage_V;
  }

  /// A wheel rests only once in a push, because the front is elastic, and two wheels that rest alternately
  /// would rock the robot for ever.
  void choose_rest() {
    if (rests_[0] || rests_[1]) {
      const std::size_t turning = rests_[0] ? 1 : 0;
      if (stall_.stood_s(turning) >= kStands_s)
        rests_ = {};  // it has come up, or cannot turn the robot alone
      return;
    }
    if (rested_) return;
    for (std::size_t side = 0; side < 2; ++side)
      rests_[side] = has_turned(side) && stall_.stood_s(side) >= kStands_s && stall_.stood_s(1 - side) == 0;
    rested_ = rests_[0] || rests_[1];
  }

  bool has_turned(std::size_t side) const {
    const WheelTravel since = watch_.travel() - start_;
    return (side == 0 ? since.left_path_m : since.right_path_m) > kStarted_m;
  }

  /// Called after the first push. That one began in front of the wall, so both wheels must have turned.
  void require_started() const {
    if (has_turned(0) && has_turned(1)) return;
    std::vector<std::string> standing;
    if (!has_turned(0)) standing.emplace_back("left");
    if (!has_turned(1)) standing.emplace_back("right");
    const std::string which = standing.size() == 1 ? "the " + standing[0] + " wheel does" : "the wheels do";
    throw NotFlush(
        which + " not turn on the voltage of the set force, unless the robot touches the wall already" +
            kFaceWall,
        WallProblem::wheels_stand, std::move(standing));
  }

  /// If a motor or an encoder is reversed, the regulator drives its wheel away from the set point, ever faster. A wheel that
  /// the wall rolls back, because the robot turns about a corner, is never faster than it crept.
  void require_sense() {
    const WheelTravel since = watch_.travel() - start_;
    const Wheels way_m{since.left_m, since.right_m};
    for (std::size_t side = 0; side < 2; ++side) {
      touched_ = touched_ || (has_turned(side) && stall_.stood_s(side) >= kStands_s);
      const std::string wheel = side == 0 ? "left" : "right";
      if (way_m[side] < -kBackwards_m && watch_.now().speed_mps[side] < -kRunsAway_mps)
        fail("by its encoder the " + wheel + " wheel runs backwards on a forward voltage",
             WallProblem::runs_backwards, {wheel});
    }
    if (crept_m() < -kBack_m)
      fail("the robot drives backwards on a forward voltage", WallProblem::runs_backwards);
    const double turned_rad = (since.right_m - since.left_m) / robot_.loaded.b_m;
    if (std::abs(turned_rad) > kMostTurn_rad)
      fail(fmt::format("the robot has turned by {:.0f} degrees {}", degrees(std::abs(turned_rad)),
                       touched_ ? "against the wall and is not flush" : "on its way to the wall"),
           touched_ ? WallProblem::turned_away : WallProblem::runs_backwards);
  }

  void pause() {
    integral_V_ = {};
    const std::uint64_t end_us = watch_.now().time_us + static_cast<std::uint64_t>(1e6 * kPause_s);
    while (watch_.now().time_us < end_us) apply({});
  }

  /// Creeps on until a wheel has stood for long enough, or until both stand under the full push; only then
  /// the result is true.
  bool push(double within_m) {
    ++touch_.pushes;
    rests_ = {};
    rested_ = false;
    double settled_s = 0;
    bool going = true;
    while (going && settled_s < kSettled_s) {
      const Wheels voltage_V = regulate();
      going = apply(voltage_V);
      const bool pressed = std::min(voltage_V[0], voltage_V[1]) >= push_V_;
      const bool still =
          std::max(std::abs(watch_.now().speed_mps[0]), std::abs(watch_.now().speed_mps[1])) < kStands_mps;
      settled_s = pressed && still ? settled_s + step_s_ : 0;
      require_sense();
      if (crept_m() > within_m)
        fail("no wall was touched within " + in_mm(within_m), WallProblem::no_wall, {in_mm(within_m)});
      if (watch_.now().time_us > end_us_)
        fail(fmt::format("the robot was not flush after {:.0f} s", time_s_), WallProblem::not_at_wall);
    }
    pause();
    return settled_s >= kSettled_s;
  }

  [[noreturn]] void fail(const std::string& why, WallProblem problem, std::vector<std::string> values = {}) {
    pause();
    const bool by_its_place = problem != WallProblem::runs_backwards;
    throw NotFlush(by_its_place ? why + kFaceWall : why, problem, std::move(values));
  }
  static std::string in_mm(double length_m) { return fmt::format("{:.0f} mm", 1000 * length_m); }

  Touch finish() {
    touch_.crept_m = crept_m();
    return touch_;
  }

  robot::DriveSession& session_;
  WheelWatch& watch_;
  robot::Client& client_;
  const WallRobot& robot_;
  double push_V_;
  WheelTravel start_;
  StallClock stall_;
  double step_s_ = kStep_s;  // of the last step
  Wheels integral_V_{};
  std::array<bool, 2> rests_{};
  bool rested_ = false;  // in this push
  bool touched_ = false;
  double time_s_ = 0;
  std::uint64_t end_us_ = 0;
  Touch touch_;
};

}  // namespace

Touch square_against_wall(robot::DriveSession& session, WheelWatch& watch, robot::Client& client,
                          const WallRobot& robot, double push_V, double within_m) {
  watch.fresh();
  return Square(session, watch, client, robot, push_V).run(within_m);
}

}  // namespace astro::wall
