#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

/// When a tracker's samples were taken: by its own clock, or by when they arrived.
namespace astro::truth {

/// One sample's two times. The sender's clock may begin anywhere; the arrival is on this computer's steady
/// clock.
struct Stamp {
  std::int64_t sender_us = 0, arrival_us = 0;
};

/// How evenly times follow each other.
struct Regularity {
  double period_s = 0;  // 0: time does not pass
  double jitter_s = 0;  // RMS of how far intervals are from whole numbers of periods, at least one
};

/// Frames that are missing do not count as jitter: an interval may be several periods long. Frames that come
/// in bursts do: an interval has at least one period.
Regularity regularity_of(std::span<const std::int64_t> times_us);

/// Maps samples to this computer's steady clock. It uses the sender's times, unless those of arrival are far more regular,
/// for example because a server stamps by a coarse clock. In doubt it uses the sender's, because arrival may be regular when
/// the choice is made, and late once the network or this computer is busy.
///
/// A sender's clock is mapped by a constant offset: the smallest delay among the first samples counts as 0. The calibration
/// finds the rest of the delay, and the drift between the two clocks, as the offset and the skew of each run. So the mapping
/// changes only if the sender's clock itself has jumped, and then so that the times go on as if it had not.
class TrackerClock {
 public:
  /// Precondition: at least one stamp.
  explicit TrackerClock(std::span<const Stamp> first);

  bool is_senders() const { return senders_; }
  const Regularity& sender() const { return sender_; }
  const Regularity& arrival() const { return arrival_; }

  std::int64_t host_time_us(const Stamp& stamp) const {
    return senders_ ? stamp.sender_us + delay_us_ : stamp.arrival_us;
  }

  /// To be called for each stamp in turn. False if the sender's clock has jumped by more than 0.1 s since the last one.
  /// Samples that the network delays are no jump.
  bool follows(const Stamp& stamp);
  /// To be called if the sender's clock may be another one from the next stamp on.
  void restart();
  /// To be called after a jump or a restart, with the first stamps since then. If it is the same clock within 0.1 s, the
  /// mapping stays; otherwise the smallest delay among them takes the place of the smallest one before. Precondition: at
  /// least one stamp.
  void continue_with(std::span<const Stamp> next);

 private:
  Regularity sender_, arrival_;
  bool senders_ = false;
  std::int64_t delay_us_ = 0;  // arrival minus sender of a sample without delay: the mapping
  std::int64_t least_us_ = 0;  // arrival minus sender of the fastest samples by now, so it drifts
  std::optional<std::int64_t>
      mapped_least_us_;  // the same of the clock that is mapped, if there is another one since
  std::optional<Stamp> last_;
};

}  // namespace astro::truth
