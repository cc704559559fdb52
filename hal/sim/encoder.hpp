#pragma once

#include <array>
#include <cstdint>
#include <numbers>

#include "hal/interface/board.hpp"
#include "hal/sim/config.hpp"

namespace astro::sim {

/// One quadrature decoder: the running count is the floor of the shaft's angle in counts. The fraction is
/// carried from call to call, so small movements add up.
class Encoder {
 public:
  /// `counts` is the shaft's movement, in counts, signed.
  void turn(double counts) {
    const double sum = fraction_ + counts;
    auto whole = static_cast<std::int64_t>(sum);
    if (sum < static_cast<double>(whole)) --whole;  // floor, without a call
    fraction_ = sum - static_cast<double>(whole);
    count_ += static_cast<std::uint32_t>(whole);
  }

  /// Sets the register, not the shaft.
  void preset(std::int32_t count) {
    count_ = static_cast<std::uint32_t>(count);
    seen_ = count_ - channel();
  }

  /// The wire of one channel breaks: the decoder takes the edges of the other channel for steps to and fro,
  /// whichever way the shaft turns.
  void lose_channel() {
    lost_ = true;
    seen_ = count_ - channel();
  }

  /// Wraps at 2^32.
  std::int32_t count() const { return static_cast<std::int32_t>(lost_ ? seen_ + channel() : count_); }

 private:
  std::uint32_t channel() const { return (count_ >> 1) & 1U; }  // high for two counts of four

  double fraction_ = 0.0;
  std::uint32_t count_ = 0;
  std::uint32_t seen_ = 0;  // by a decoder with one channel, while that is low
  bool lost_ = false;
};

/// Both decoders, as they are wired.
class Encoders {
 public:
  explicit Encoders(const Config& config)
      : swapped_(config.wiring.encoders_swapped),
        connected_per_rad_(signed_scale(config)),
        counts_per_rad_(connected_per_rad_) {
    if (config.wiring.left_encoder_dead) unplug(Side::left);
    if (config.wiring.right_encoder_dead) unplug(Side::right);
    if (config.wiring.left_channel_lost) lose_channel(Side::left);
    if (config.wiring.right_channel_lost) lose_channel(Side::right);
  }

  hal::EncoderCounts read() noexcept { return {decoder_[0].count(), decoder_[1].count()}; }

  /// Rotation of both wheels, rad, forward positive.
  void turn(const Pair& wheels_rad) {
    for (std::size_t wheel = 0; wheel < 2; ++wheel)
      decoder_of(wheel).turn(wheels_rad[wheel] * counts_per_rad_[wheel]);
  }

  void preset(const hal::EncoderCounts& value) {
    decoder_[0].preset(value.left);
    decoder_[1].preset(value.right);
  }

  /// The cable of one wheel's encoder comes off: its count does not change any more.
  void unplug(Side wheel) { counts_per_rad_[at(wheel)] = 0.0; }
  void plug_in(Side wheel) { counts_per_rad_[at(wheel)] = connected_per_rad_[at(wheel)]; }

  /// One of the two channels of that wheel's encoder breaks.
  void lose_channel(Side wheel) { decoder_of(at(wheel)).lose_channel(); }

 private:
  static Pair signed_scale(const Config& config) {
    const double per_rad = config.counts_per_motor_rev * config.gear_ratio / (2.0 * std::numbers::pi);
    return {config.wiring.left_encoder_reversed ? -per_rad : per_rad,
            config.wiring.right_encoder_reversed ? -per_rad : per_rad};
  }
  Encoder& decoder_of(std::size_t wheel) { return decoder_[swapped_ ? 1 - wheel : wheel]; }

  bool swapped_;
  Pair connected_per_rad_, counts_per_rad_;  // by wheel
  std::array<Encoder, 2> decoder_;           // by the name that the firmware knows
};

}  // namespace astro::sim
