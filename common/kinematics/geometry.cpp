#include "common/kinematics/geometry.hpp"

#include "common/fixed/wide.hpp"

namespace astro {
namespace {

// c * D * gear_denominator, with c in 2^-30 and D in nm, still to be divided by gear_numerator * n.
Natural scaled_diameter(const ParameterSet& set, Param factor) {
  Natural product(static_cast<std::uint64_t>(set.get(factor)));
  product *= static_cast<std::uint32_t>(set.get(Param::wheel_diameter));
  product *= static_cast<std::uint32_t>(set.get(Param::gear_denominator));
  return product;
}

void divide_by_counts(Natural& value, const ParameterSet& set) {
  value /= static_cast<std::uint32_t>(set.get(Param::gear_numerator));
  value /= static_cast<std::uint32_t>(set.get(Param::counts_per_motor_rev));
}

// pi = 21053343141 / 6701487259, a convergent of its continued fraction with an error of 9e-23, as factors
// that fit into 32 bits.
Natural times_pi(Natural value) {
  value *= 14'007'547;
  value *= 1'503;
  return value;
}

void divide_by_pis_denominator(Natural& value) {
  value /= 450'157;
  value /= 14'887;
}

[[gnu::cold]] Geometry::Wheel make_wheel(const ParameterSet& set, Param factor) {
  constexpr std::uint32_t kNanometresPerMetre = 1'000'000'000;
  Geometry::Wheel wheel;

  Natural half_travel = times_pi(scaled_diameter(set, factor));  // 2^-30 nm, for the whole travel
  half_travel <<= 61 - 30 - 1 + 1;                               // half the travel, one bit for rounding
  divide_by_counts(half_travel, set);
  divide_by_pis_denominator(half_travel);
  half_travel /= kNanometresPerMetre;
  wheel.half_travel = half_travel.half_rounded();

  Natural turn = scaled_diameter(set, factor);  // nm and nm cancel
  turn <<= 64 - 30 - 1 + 1;
  divide_by_counts(turn, set);
  turn /= static_cast<std::uint32_t>(set.get(Param::b));
  wheel.turn = turn.half_rounded();

  Natural speed = times_pi(scaled_diameter(set, factor));  // per tick: * 1000; in um: / 1000
  speed <<= 12 + 1;
  divide_by_counts(speed, set);
  divide_by_pis_denominator(speed);
  speed /= std::uint32_t{1} << 30;
  static_assert(kTickHz == 1000, "nanometres per tick are micrometres per second only at 1 kHz");
  wheel.speed = speed.half_rounded();
  return wheel;
}

}  // namespace

Geometry make_geometry(const ParameterSet& set) {
  constexpr std::int64_t kNanometresPerMetre = 1'000'000'000;
  const std::int64_t base_nm = set.get(Param::b);
  Geometry geometry;
  geometry.left = make_wheel(set, Param::c_L);
  geometry.right = make_wheel(set, Param::c_R);
  geometry.half_base_30 =
      static_cast<std::int32_t>(((base_nm << 29) + kNanometresPerMetre / 2) / kNanometresPerMetre);
  geometry.inverse_base_25 = static_cast<std::int32_t>(((kNanometresPerMetre << 25) + base_nm / 2) / base_nm);
  geometry.effective_base = EffectiveBase(set);
  return geometry;
}

}  // namespace astro
