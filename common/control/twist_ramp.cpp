#include "common/control/twist_ramp.hpp"

#include "common/fixed/saturate.hpp"

namespace astro {
namespace {

constexpr std::int64_t at_least_one(std::int64_t value) { return value < 1 ? 1 : value; }

}  // namespace

void TwistRamp::Axis::set_target(std::int32_t target, std::int64_t acceleration, std::int64_t jerk) {
  target_ = std::int64_t{target} << kBits;
  most_ = at_least_one(acceleration);
  jerk_ = at_least_one(jerk < most_ ? jerk : most_);
  far_ = most_ * (most_ + jerk_) / (2 * jerk_) + 1;
}

void TwistRamp::Axis::take_target(const Axis& planned) {
  target_ = planned.target_;
  most_ = planned.most_;
  jerk_ = planned.jerk_;
  far_ = planned.far_;
}

void TwistRamp::Axis::set(std::int32_t value) {
  value_ = target_ = std::int64_t{value} << kBits;
  rate_ = 0;
}

// If the rate falls by one jerk per tick, it still covers rate (rate + jerk) / (2 jerk).
bool TwistRamp::Axis::stops_within(std::int64_t rate, std::int64_t gap) const {
  return rate <= 0 || gap >= far_ || rate * (rate + jerk_) <= 2 * jerk_ * gap;
}

std::int64_t TwistRamp::Axis::next(std::int64_t rate, std::int64_t gap) const {
  if (rate > most_) return rate - jerk_ > most_ ? rate - jerk_ : most_;
  const std::int64_t more = rate + jerk_ < most_ ? rate + jerk_ : most_;
  if (stops_within(more, gap)) return more;
  return stops_within(rate, gap) ? rate : rate - jerk_;
}

void TwistRamp::Axis::advance() {
  const std::int64_t direction = gap() < 0 ? -1 : 1;
  const std::int64_t gap_now = magnitude(gap()), rate = direction * rate_;
  if (gap_now <= jerk_ && rate >= 0 && rate <= 2 * jerk_) {
    value_ = target_;
    rate_ = 0;
    return;
  }
  rate_ = direction * next(rate, gap_now);
  value_ += rate_;
}

std::int32_t TwistRamp::Axis::acceleration() const { return saturate32(rate_ * kTickHz >> kBits); }

TwistRamp::Limits TwistRamp::per_tick(std::int32_t acceleration, std::int32_t jerk_milli) {
  const std::int64_t change = at_least_one((std::int64_t{acceleration} << kBits) / kTickHz);
  // 1e-3 per s^3 is 1e-6 of the unit per tick^2 in thousandths.
  const std::int64_t jerk = (std::int64_t{jerk_milli} << kBits) / 1000;
  const std::int64_t least = change / kSlowestRise_ticks + 1;
  return {change, jerk_milli == 0 ? change : jerk > least ? jerk : least};
}

TwistRamp::Rates::Rates(const MotionLimits& limits)
    : v(per_tick(limits.acceleration_umps2, limits.jerk_mmps3)),
      omega(per_tick(limits.yaw_acceleration_uradps2, limits.yaw_jerk_mradps3)) {}

void TwistRamp::set(const BodyTwist& value) {
  v_.set(value.v_umps);
  omega_.set(value.omega_uradps);
  target_ = value;
}

void TwistRamp::set_target(const BodyTwist& target) {
  if (target == target_) return;
  target_ = target;
  plan();
}

void TwistRamp::take_target(const TwistRamp& planned) {
  target_ = planned.target_;
  v_.take_target(planned.v_);
  omega_.take_target(planned.omega_);
}

// The component that would take longer goes as fast as its limits allow, and the other in proportion to it.
void TwistRamp::plan() {
  const std::int64_t v_way = magnitude(v_.gap_to(target_.v_umps)) >> kBits;
  const std::int64_t omega_way = magnitude(omega_.gap_to(target_.omega_uradps)) >> kBits;
  Limits v = rates_.v, omega = rates_.omega;
  // A component that is already changing needs its full jerk to stop changing.
  if (v_way != 0 && omega_way != 0 && v_.steady() && omega_.steady()) {
    const bool v_leads = v_way * omega.acceleration >= omega_way * v.acceleration;
    if (v_leads) {
      follow(omega, v, omega_way, v_way);
    } else {
      follow(v, omega, v_way, omega_way);
    }
  }
  v_.set_target(target_.v_umps, v.acceleration, v.jerk);
  omega_.set_target(target_.omega_uradps, omega.acceleration, omega.jerk);
}

// The leader's jerk is reduced if the follower's would exceed its limit.
void TwistRamp::follow(Limits& follower, Limits& leader, std::int64_t way, std::int64_t leaders_way) {
  follower.acceleration = at_least_one(leader.acceleration * way / leaders_way);
  const std::int64_t jerk = leader.jerk * way / leaders_way;
  if (jerk > follower.jerk) {
    leader.jerk = at_least_one(follower.jerk * leaders_way / way);
  } else {
    follower.jerk = at_least_one(jerk);
  }
}

void TwistRamp::advance() {
  v_.advance();
  omega_.advance();
}

}  // namespace astro
