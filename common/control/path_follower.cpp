#include "common/control/path_follower.hpp"

#include "common/fixed/saturate.hpp"
#include "common/fixed/trig.hpp"
#include "common/fixed/wide.hpp"

namespace astro {
namespace {

// 2^-50 m per tick to 1e-6 m/s: * 1000 * 10^6 / 2^50. A tick's travel at the fastest legal speed is 0.01 m.
constexpr std::int32_t to_umps(std::int64_t travel_50) {
  return mul_high(static_cast<std::int32_t>(travel_50 >> 18), 1'000'000'000);
}

// 2^-52 turn per tick to 1e-6 rad/s: * 2 pi * 1000 * 10^6 / 2^52. A tick's turn at the fastest legal yaw rate is 0.05 rad.
constexpr std::int32_t to_uradps(std::int64_t turn_52) {
  constexpr std::int64_t kTwoPi_9 = 6'283'185'307, kWhole = std::int64_t{1} << 32;
  const auto turn_32 = static_cast<std::int32_t>(turn_52 >> 20);
  return turn_32 + mul_high(turn_32, static_cast<std::int32_t>(kTwoPi_9 - kWhole));
}

// What changes so much in a tick. No legal profile comes near the limit.
constexpr std::int32_t per_second(std::int32_t change) {
  return clamp_abs(change, INT32_MAX / kTickHz) * kTickHz;
}

// The errors are limited, so that a robot that is far behind hurries but does not jump.
constexpr int kErrorBits = 29;  // of 2^-30 m: 0.25 m
constexpr int kTurnBits = 29;   // of 2^-32 turn: 1/16 turn

constexpr std::int32_t kClose_um = 500;
constexpr std::int32_t kClose_urad = 1'000;

// The high word is in 2^-28 m.
constexpr std::int32_t um_from_60(std::int64_t metres_60) {
  return mul_rounded<28>(static_cast<std::int32_t>(metres_60 >> 32), 1'000'000);
}

}  // namespace

void PathFollower::set_gains(const ParameterSet& set) {
  k_along_ = Q16::from_raw(set.get(Param::path_k_along));
  k_cross_ = Q16::from_raw(set.get(Param::path_k_cross));
  k_heading_ = Q16::from_raw(set.get(Param::path_k_heading));
}

void PathFollower::begin_path(const Pose& pose) {
  reference_.set_pose(pose);
  begin({});
  last_ = correction_ = {};
}

PathFollower::Command PathFollower::advance(const Pose& actual, bool corrects) {
  BodyTwist wanted;
  if (!profile_.done()) {
    const Trapezoid::Step step = profile_.advance();
    wanted = {to_umps(step.travel), to_uradps(step.turn)};
  }
  if (corrects) {
    move_reference();
    correction_ = correction(actual, wanted.v_umps);
  }
  Command command;
  command.twist = {add_saturated(wanted.v_umps, correction_.v_umps),
                   add_saturated(wanted.omega_uradps, correction_.omega_uradps)};
  command.acceleration = {per_second(wanted.v_umps - last_.v_umps),
                          per_second(wanted.omega_uradps - last_.omega_uradps)};
  last_ = wanted;
  return command;
}

// Length and angle of a segment advance together, so that the steps of several ticks are one arc.
void PathFollower::move_reference() {
  const Trapezoid::Step& given = profile_.given();
  const Trapezoid::Step step{given.travel - moved_.travel, given.turn - moved_.turn};
  moved_ = given;
  if (step.travel == 0) {
    reference_.spin(step.turn * 4096);
  } else if (step.turn == 0) {
    reference_.advance_straight(step.travel * 2048, heading());
  } else {
    reference_.advance(step.travel * 2048, step.turn * 4096);
  }
}

const SinCos& PathFollower::heading() {
  const Angle now = reference_.pose().theta;
  if (!(now == heading_of_)) {
    heading_ = sin_cos(now);
    heading_of_ = now;
  }
  return heading_;
}

BodyTwist PathFollower::correction(const Pose& actual, std::int32_t v_ref_umps) {
  const Pose& reference = reference_.pose();
  const std::int32_t dx_30 = saturate_to<kErrorBits>(saturate32((reference.x - actual.x) >> 10));
  const std::int32_t dy_30 = saturate_to<kErrorBits>(saturate32((reference.y - actual.y) >> 10));
  const SinCos& towards = heading();
  const auto cos_30 = static_cast<std::int32_t>(towards.cos >> 13);
  const auto sin_30 = static_cast<std::int32_t>(towards.sin >> 13);
  const std::int32_t along_um = um_from_60(mul_add(mul_wide(dx_30, cos_30), dy_30, sin_30));
  const std::int32_t cross_um = um_from_60(mul_add(mul_wide(dy_30, cos_30), dx_30, -sin_30));
  const std::int32_t turn_32 =
      saturate_to<kTurnBits>(static_cast<std::int32_t>((reference.theta - actual.theta) >> 32));
  constexpr std::int32_t kTurn_urad = 6'283'185;
  const std::int32_t heading_urad = mul_high(turn_32, kTurn_urad);

  cross_um_ = cross_um;
  heading_urad_ = heading_urad;
  close_ = !exceeds(along_um, kClose_um) && !exceeds(heading_urad, kClose_urad);

  // (um/s) * um = 1e-12, brought back to 1e-6 by 1 / 10^6 = 4295 / 2^32.
  const auto swept_8 = saturate32(mul_wide(v_ref_umps, cross_um) >> 8);
  const auto swept = static_cast<std::int32_t>(mul_wide(swept_8, 4295) >> 24);
  return {saturate32(k_along_.scale(along_um)),
          saturate32(k_heading_.scale(heading_urad) + k_cross_.scale(swept))};
}

}  // namespace astro
