#include "host/experiment/wall/touch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>

namespace astro::experiment {
namespace {

using namespace std::chrono_literals;

constexpr std::uint64_t kStep_us = 20'000;  // between voltages, a tenth of the robot's time-out
constexpr double kStep_s = 1e-6 * kStep_us;
constexpr double kStands_mps = 0.003;  // as the firmware's own limit for a stopped wheel
constexpr double kStands_s = 0.1;      // a wheel that stands for so long is at the wall
constexpr double kStarted_m = 0.001;   // a wheel that has rolled so far turns
constexpr double kSettled_s = 0.25;    // both wheels stand under the full push for so long
constexpr double kSame_m = 0.0005;     // two pushes that end so close ended at the same place
constexpr int kMostPushes = 20;
constexpr double kPushing_s = 30;   // besides the way there
constexpr std::size_t kWindow = 5;  // steps
constexpr double kSpeedGain_Vspm = 10, kIntegral_Vpm = 250;

class Square {
 public:
  Square(robot::DriveSession& session, WheelWatch& watch, robot::Client& client, const WallRobot& robot,
         double push_V)
      : session_(session),
        watch_(watch),
        client_(client),
        robot_(robot),
        push_V_(push_V),
        start_(watch.travel()) {}

  Touch run(double within_m) {
    time_s_ = kPushing_s + within_m / kCreep_mps;
    end_us_ = watch_.now().time_us + static_cast<std::uint64_t>(1e6 * time_s_);
    calibration::WheelTravel before = start_;
    while (touch_.pushes < kMostPushes) {
      const bool settled = push(within_m);
      if (touch_.pushes == 1) require_started();
      const calibration::WheelTravel moved = watch_.travel() - before;
      before = watch_.travel();
      const bool same = std::max(std::abs(moved.right_m), std::abs(moved.left_m)) < kSame_m;
      if (settled && same) return finish();
    }
    throw NotFlush(fmt::format("the robot was still moving after {} pushes against the wall", kMostPushes));
  }

 private:
  using Wheels = std::array<double, 2>;

  double crept_m() const {
    const calibration::WheelTravel since = watch_.travel() - start_;
    return (since.right_m + since.left_m) / 2;
  }

  /// One step; false as soon as a wheel has stood under voltage for long enough.
  bool apply(const Wheels& voltage_V) {
    session_.set_wheel_voltages(voltage_V[0], voltage_V[1]);
    const std::uint64_t next_us = watch_.now().time_us + kStep_us;
    client_.pump_until([&] { return watch_.now().time_us >= next_us; }, 60ms);
    const double step_s = 1e-6 * static_cast<double>(watch_.now().time_us - (next_us - kStep_us));
    for (std::size_t side = 0; side < 2; ++side) note_stall(side, voltage_V[side], step_s);
    return std::max(stalled_s_[0], stalled_s_[1]) < kStall_s - kStep_s;
  }

  /// A wheel that has voltage and moves by less than two counts and a half in a tenth of a second stands: slower than 1 mm/s it cannot
  /// make more. Its speed would not show that, because a count now and then looks like a wheel that turns.
  void note_stall(std::size_t side, double voltage_V, double step_s) {
    const double at_m = side == 0 ? watch_.travel().left_m : watch_.travel().right_m;
    std::array<double, kWindow>& was_at_m = was_at_m_[side];
    const bool stands = voltage_V > 0 && std::abs(at_m - was_at_m.front()) < 2.5 * robot_.count_m;
    std::shift_left(was_at_m.begin(), was_at_m.end(), 1);
    was_at_m.back() = at_m;
    stalled_s_[side] = stands ? stalled_s_[side] + step_s : 0;
    touch_.longest_stall_s = std::max(touch_.longest_stall_s, stalled_s_[side]);
  }

  /// Each wheel at the creeping speed, as long as the push allows. A wheel that stands under the full push while the other one turns is
  /// on the side that touches: it rests until the other one has come up. Otherwise it would be stalled all that time, and where the robot turns about
  /// its corner it would be turned back, and its friction would press on the wall as well.
  Wheels regulate() {
    choose_rest();
    Wheels voltage_V{};
    for (std::size_t side = 0; side < 2; ++side) {
      if (rests_[side]) {
        integral_V_[side] = 0;
        continue;
      }
      const double missing_mps = kCreep_mps - watch_.now().speed_mps[side];
      const double known_V = robot_.kS_V[side] + robot_.kV_Vspm[side] * kCreep_mps;
      integral_V_[side] =
          std::clamp(integral_V_[side] + kIntegral_Vpm * missing_mps * kStep_s, -known_V, push_V_);
      voltage_V[side] = std::clamp(known_V + kSpeedGain_Vspm * missing_mps + integral_V_[side], 0.0, push_V_);
    }
    return voltage_V;
  }

  /// Once in a push: the front is elastic, and two wheels that take turns would rock the robot for ever.
  void choose_rest() {
    if (rests_[0] || rests_[1]) {
      const std::size_t turning = rests_[0] ? 1 : 0;
      if (stalled_s_[turning] >= kStands_s) rests_ = {};  // it has come up, or cannot turn the robot alone
      return;
    }
    if (rested_) return;
    for (std::size_t side = 0; side < 2; ++side)
      rests_[side] = has_turned(side) && stalled_s_[side] >= kStands_s && stalled_s_[1 - side] == 0;
    rested_ = rests_[0] || rests_[1];
  }

  bool has_turned(std::size_t side) const {
    const calibration::WheelTravel since = watch_.travel() - start_;
    return (side == 0 ? since.left_path_m : since.right_path_m) > kStarted_m;
  }

  /// After the first push, which began in front of the wall.
  void require_started() const {
    if (has_turned(0) && has_turned(1)) return;
    const std::string which = has_turned(1)   ? "the left wheel does"
                              : has_turned(0) ? "the right wheel does"
                                              : "the wheels do";
    throw NotFlush(which + " not turn on the voltage of the set force");
  }

  void pause() {
    integral_V_ = {};
    stalled_s_ = {};
    const std::uint64_t end_us = watch_.now().time_us + static_cast<std::uint64_t>(1e6 * kPause_s);
    while (watch_.now().time_us < end_us) apply({});
  }

  /// Creeps on until a wheel has stood for long enough, or both stand under the full push: then true.
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
      settled_s = pressed && still ? settled_s + kStep_s : 0;
      if (crept_m() > within_m) fail("no wall was touched within " + in_mm(within_m));
      if (watch_.now().time_us > end_us_)
        fail(fmt::format("the robot was not flush after {:.0f} s", time_s_));
    }
    pause();
    return settled_s >= kSettled_s;
  }

  [[noreturn]] void fail(const std::string& why) {
    pause();
    throw NotFlush(why);
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
  calibration::WheelTravel start_;
  Wheels integral_V_{}, stalled_s_{};
  std::array<bool, 2> rests_{};
  bool rested_ = false;  // in this push
  double time_s_ = 0;
  std::uint64_t end_us_ = 0;
  std::array<std::array<double, kWindow>, 2> was_at_m_{};  // in the last steps
  Touch touch_;
};

}  // namespace

Touch square_against_wall(robot::DriveSession& session, WheelWatch& watch, robot::Client& client,
                          const WallRobot& robot, double push_V, double within_m) {
  watch.fresh();
  return Square(session, watch, client, robot, push_V).run(within_m);
}

}  // namespace astro::experiment
