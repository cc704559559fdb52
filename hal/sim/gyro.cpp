#include "hal/sim/gyro.hpp"

#include <algorithm>
#include <cmath>

#include "hal/sim/noise.hpp"

namespace astro::sim {
namespace {

// Streams of random numbers; three for the axes' noise. Wheels use 0 and 1, the board's id 0x1D and 0x5E.
constexpr std::uint64_t kNoiseStream = 0x60, kWalkStream = 0x63;
constexpr double kTick_s = 1e-3, kPeriod_s = Gyro::kPeriod_ticks * kTick_s;

}  // namespace

Gyro::Gyro(const Config& config) : exists_(config.gyro.has_value()), seed_(config.seed) {
  if (!exists_) return;
  gyro_ = *config.gyro;
  headings_.resize(static_cast<std::size_t>(kPeriod_ticks + std::lround(gyro_.lag_s / kTick_s)) + 1);
  restart();
}

void Gyro::restart() {
  reading_ = {};
  ticks_ = 0;
  if (exists_ && fault_ != GyroFault::unplugged) reading_.state = hal::GyroReading::State::starting;
}

void Gyro::place(double heading_rad) { std::fill(headings_.begin(), headings_.end(), heading_rad); }

double Gyro::bias_radps() const {
  return gyro_.bias_radps + walked_radps_ + gyro_.bias_per_K_radps * (gyro_.temperature_C - 25.0);
}

void Gyro::advance(double heading_rad) {
  using State = hal::GyroReading::State;
  at_ = at_ + 1 < headings_.size() ? at_ + 1 : 0;
  headings_[at_] = heading_rad;
  if (fault_ == GyroFault::unplugged) {
    if (reading_.state != State::absent) reading_.state = State::failed;
    ticks_ = 0;
    return;
  }
  if (++ticks_ < kStart_ticks) {
    reading_.state = State::starting;
    return;
  }
  if ((ticks_ - kStart_ticks) % kPeriod_ticks != 0 || fault_ == GyroFault::silent) return;
  reading_.state = State::running;
  ++reading_.number;
  if (fault_ != GyroFault::frozen) sample();
}

void Gyro::sample() {
  // The oldest heading of the ring is the one behind the newest.
  const std::size_t size = headings_.size(), oldest = at_ + 1 < size ? at_ + 1 : 0;
  const std::size_t newest = (oldest + kPeriod_ticks) % size;
  const double turned = headings_[newest] - headings_[oldest];
  walked_radps_ += gyro_.bias_walk_radps * std::sqrt(kPeriod_s) * gauss(seed_, kWalkStream, number_);
  const double rate = gyro_.scale * turned / kPeriod_s + bias_radps();
  const auto up = static_cast<std::size_t>(std::abs(gyro_.axis) - 1);
  for (std::size_t axis = 0; axis < 3; ++axis)
    reading_.rate[axis] = counts(axis != up ? 0.0 : gyro_.axis > 0 ? rate : -rate, axis);
  reading_.count_nradps = static_cast<std::uint32_t>(std::lround(kCount_radps * 1e9));
  reading_.temperature_cC = static_cast<std::int16_t>(std::lround(gyro_.temperature_C) * 100);
  ++number_;
}

std::int16_t Gyro::counts(double rate_radps, std::uint64_t axis) const {
  const double noisy = rate_radps + gyro_.angle_random_walk_rad / std::sqrt(kPeriod_s) *
                                        gauss(seed_, kNoiseStream + axis, number_);
  return static_cast<std::int16_t>(std::lround(std::clamp(noisy / kCount_radps, -32768.0, 32767.0)));
}

}  // namespace astro::sim
