#include "host/motor/bench/identify.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/base/error.hpp"

namespace astro::motor {
namespace {

using motor::Sample;

constexpr double kSlope_Vps = 1.0;  // slow compared with any motor's time constant
constexpr double kStands =
    0.7;  // of the allowed voltage: a wheel that stands still at this voltage will not turn
constexpr double kMostStanding_V = 4.5;  // above this the firmware soon reports a stall
constexpr double kFeeble_V = 3;          // a healthy motor may need this much
constexpr double kTurnRound = 0.4;       // of the allowed distance; the rest is for braking
constexpr double kStepAtMost_s = 0.6, kRest_s = 0.4;
constexpr double kBackward_m = 0.015;
constexpr int kRepeats = 2;
constexpr std::array kStepParts{0.6, 1.0};

class Course {
 public:
  Course(Bench& bench, robot::DriveSession& session, const Bounds& bounds,
         const std::function<void(double)>& progress)
      : bench_(bench), session_(session), bounds_(bounds), progress_(progress), origin_(bench.fresh()) {}

  IdentifiedMotors run();

 private:
  double moved_m(Side side, const Moment& from) const {
    return bench_.now().position_m[at(side)] - from.position_m[at(side)];
  }
  double furthest_m(const Moment& from) const {
    return std::max(std::abs(moved_m(Side::left, from)), std::abs(moved_m(Side::right, from)));
  }
  void apply(double voltage_V);
  void check_room() const;
  void check_sense(double voltage_V, const Moment& from) const;
  std::size_t sweep(double sense);
  void step(double voltage_V);
  void done(double seconds);
  std::vector<Sample> samples(Side side, std::size_t begin, std::size_t end) const;
  IdentifiedMotor identity(Side side) const;

  Bench& bench_;
  robot::DriveSession& session_;
  const Bounds& bounds_;
  const std::function<void(double)>& progress_;
  Moment origin_;
  std::array<std::size_t, 2> rise_begin_{}, rise_end_{};  // indices of moments; forward, backward
};

void Course::apply(double voltage_V) {
  bench_.apply(session_, voltage_V, voltage_V);
  check_room();
  const double sweep_s = 4 * bounds_.voltage_V / kSlope_Vps + 1, steps_s = 8 * (kStepAtMost_s + kRest_s);
  progress_((bench_.now().time_s - origin_.time_s) / (sweep_s + steps_s));
}

void Course::check_room() const {
  for (const Side side : kSides)
    if (std::abs(moved_m(side, origin_)) > bounds_.distance_m)
      throw Error(fmt::format("stopped: the {} wheel got further than {:g} m from its start", name(side),
                              bounds_.distance_m),
                  BenchProblem::out_of_room, {name(side), fmt::format("{:g}", bounds_.distance_m)});
}

// Ends the measurement if the robot turns on the spot or a wheel does not turn.
void Course::check_sense(double voltage_V, const Moment& from) const {
  const double stands_V = std::min(kStands * bounds_.voltage_V, kMostStanding_V);
  for (const Side side : kSides) {
    const double forward_m = moved_m(side, from) * std::copysign(1.0, voltage_V);
    if (forward_m < -kBackward_m)
      throw Error(fmt::format("stopped: the {} wheel counts backward under forward voltage", name(side)),
                  BenchProblem::counts_backward, {name(side)});
    if (std::abs(voltage_V) >= stands_V && std::abs(forward_m) < 10 * bench_.facts().count_m[at(side)])
      throw Error(fmt::format("stopped: the {} wheel does not turn, or does not count, at {:.1f} V",
                              name(side), std::abs(voltage_V)),
                  stands_V < kFeeble_V ? BenchProblem::stands_at_little_voltage : BenchProblem::stands,
                  {name(side)});
  }
}

// Raises the voltage until voltage or distance reach their bounds, then lowers it. Returns the index of the
// moment at which the rise ended.
std::size_t Course::sweep(double sense) {
  const Moment start = bench_.now();
  double top_V = 0;
  while (top_V < bounds_.voltage_V && furthest_m(start) < 0.8 * kTurnRound * bounds_.distance_m) {
    top_V = std::min((bench_.now().time_s - start.time_s) * kSlope_Vps, bounds_.voltage_V);
    apply(sense * top_V);
    check_sense(sense * top_V, start);
  }
  const std::size_t turn = bench_.moments().size();
  const double turn_s = bench_.now().time_s;
  for (double volts = top_V; volts > 0;) {
    volts = std::max(0.0, top_V - (bench_.now().time_s - turn_s) * kSlope_Vps);
    apply(sense * volts);
  }
  done(kRest_s);
  return turn;
}

void Course::step(double voltage_V) {
  const Moment start = bench_.now();
  while (bench_.now().time_s - start.time_s < kStepAtMost_s &&
         furthest_m(start) < kTurnRound * bounds_.distance_m)
    apply(voltage_V);
  done(kRest_s);
}

// At zero volts the bridge shorts the motor, which brakes it.
void Course::done(double seconds) {
  const double end_s = bench_.now().time_s + seconds;
  while (bench_.now().time_s < end_s) apply(0);
}

std::vector<Sample> Course::samples(Side side, std::size_t begin, std::size_t end) const {
  std::vector<Sample> list;
  const std::size_t k = at(side);
  for (std::size_t i = begin; i < end; ++i) {
    const Moment& moment = bench_.moments()[i];
    list.push_back({moment.time_s, moment.voltage_V[k], moment.position_m[k]});
  }
  return list;
}

IdentifiedMotor Course::identity(Side side) const {
  const double count_m = bench_.facts().count_m[at(side)];
  const auto broke = [&](std::size_t way) {
    auto volts = breakaway_V(samples(side, rise_begin_[way], rise_end_[way]), count_m);
    if (volts) volts = std::abs(*volts);
    return volts;
  };
  IdentifiedMotor wheel;
  wheel.breakaway_forward_V = broke(0);
  wheel.breakaway_backward_V = broke(1);
  try {
    wheel.fit = fit_motor(samples(side, rise_begin_[0], bench_.moments().size()), count_m);
  } catch (const Error& error) {
    throw Error(error.in(fmt::format("the {} wheel ", name(side))));
  }
  return wheel;
}

IdentifiedMotors Course::run() {
  for (const std::size_t way : {0U, 1U}) {
    rise_begin_[way] = bench_.moments().size();
    rise_end_[way] = sweep(way == 0 ? 1.0 : -1.0);
  }
  for (int repeat = 0; repeat < kRepeats; ++repeat)
    for (const double part : kStepParts)
      for (const double sense : {1.0, -1.0}) step(sense * part * bounds_.voltage_V);
  session_.stop();
  return {{identity(Side::left), identity(Side::right)}, bench_.now().time_s - origin_.time_s};
}

}  // namespace

double IdentifiedMotor::breakaway_V() const {
  const double forward_V = breakaway_forward_V.value_or(fit.model.kS);
  const double backward_V = breakaway_backward_V.value_or(forward_V);
  return std::max((forward_V + backward_V) / 2, fit.model.kS);
}

IdentifiedMotors identify(Bench& bench, robot::DriveSession& session, const Bounds& bounds,
                          const std::function<void(double)>& progress) {
  return Course(bench, session, bounds, progress).run();
}

}  // namespace astro::motor
