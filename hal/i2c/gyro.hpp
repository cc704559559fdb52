#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "hal/i2c/bus.hpp"
#include "hal/i2c/gyro_chips.hpp"
#include "hal/interface/board.hpp"

namespace astro::i2c {

/// A gyro of gyro_chips.hpp at a bus: finds it, starts it, and fetches a sample every five ticks. A chip that does not answer, that
/// measures nothing at all, that repeats itself for 0.2 s, or whose bus hangs has failed; then the bus is released, and a second
/// later the search begins anew. After a single transfer that is lost the bus is released, and the samples go on.
///
/// Cost    call read() once a tick. A few instructions in most ticks, a sample's decoding in one of five. Without a gyro one
///         transfer for each address, once a second.
template <Bus B>
class Gyro {
 public:
  static constexpr int kPeriod_ticks = 5;

  explicit Gyro(B& bus) : bus_(bus) {}

  const hal::GyroReading& read() noexcept {
    if (pause_ticks_ != 0) {
      --pause_ticks_;
      return reading_;
    }
    if (fetched_) {
      fetched_ = false;
      decode();
      return reading_;
    }
    if (!under_way_) {
      begin();
      return reading_;
    }
    ++busy_ticks_;
    const Transfer at = bus_.advance();
    if (at == Transfer::busy) {
      if (busy_ticks_ >= kHangs_ticks) hang();
      return reading_;
    }
    under_way_ = false;
    if (step_ == Step::sample) {
      note_sample(at);
    } else {
      go_on(at);
    }
    return reading_;
  }

 private:
  using State = hal::GyroReading::State;
  enum class Step : std::uint8_t {
    find,
    ask_bank,     // of a chip that has not said its identity
    select_bank,  // 0, and then the search begins anew
    start,
    sample,
    release,           // and then the search begins anew
    release_and_go_on  // with samples of the same chip
  };

  static constexpr int kHangs_ticks = 30;     // releasing a bus takes 22, any transfer five
  static constexpr int kMostMisses = 4;       // samples in a row that fail in a chip that works
  static constexpr int kFrozen_samples = 40;  // noise moves some axis in each, in a chip that works
  static constexpr int kSearch_ticks = 1000;  // between two searches
  static constexpr int kPowerUp_ticks = 100;  // until the slowest chip answers: MPU-6050, data sheet 3.4, 6.2
  static constexpr std::size_t kCandidates = 2 * kGyroChips.size();

  const GyroChip& chip() const { return kGyroChips[candidate_ / 2]; }
  std::uint8_t address() const { return chip().addresses[candidate_ % 2]; }

  void begin() {
    under_way_ = true;
    busy_ticks_ = 0;
    if (step_ == Step::sample) return bus_.begin_read(address(), chip().from, chip().count);
    begin_other();
  }
  [[gnu::noinline]] void begin_other() {
    if (step_ == Step::find) return bus_.begin_read(address(), chip().id_register, 1);
    if (step_ == Step::ask_bank) return bus_.begin_read(address(), chip().bank_register, 1);
    if (step_ == Step::select_bank) return bus_.begin_write(address(), chip().bank_register, 0);
    const Setting& setting = chip().start[setting_];
    bus_.begin_write(address(), setting.number, setting.value);
  }

  void note_sample(Transfer at) {
    if (at != Transfer::done || bus_.bytes()[chip().count - 1U] == 0xFF) [[unlikely]] {
      pause_ticks_ = std::max(kPeriod_ticks - 1 - busy_ticks_, 0);
      return miss(at == Transfer::lost);
    }
    fetched_ = true;
  }
  /// A transfer is lost by a spike on a line, too, and then the chip goes on as it was set up.
  [[gnu::noinline]] void miss(bool lost) {
    if (++misses_ >= kMostMisses) return fail(lost);
    if (lost) release(Step::release_and_go_on);
  }

  /// In a tick of its own.
  void decode() {
    pause_ticks_ = std::max(kPeriod_ticks - 2 - busy_ticks_, 0);
    const auto bytes = bus_.bytes();
    const auto word = [&bytes](std::size_t place) {
      return static_cast<std::int16_t>(bytes[place] << 8 | bytes[place + 1]);
    };
    const std::size_t place = chip().rate_at;
    const std::array<std::int16_t, 3> rate{word(place), word(place + 2), word(place + 4)};
    // A chip that has lost its power for a moment acknowledges everything, but does not measure: its registers are 0.
    if ((rate[0] | rate[1] | rate[2]) == 0) [[unlikely]]
      return miss(false);
    misses_ = 0;
    same_ = hal::same_rate(rate, reading_.rate) ? same_ + 1 : 0;
    reading_.rate = rate;
    if (chip().temperature_at != GyroChip::kNoTemperature)
      reading_.temperature_cC = static_cast<std::int16_t>(
          (word(chip().temperature_at) * chip().temperature_16 >> 16) + chip().temperature_zero_cC);
    ++reading_.number;
    reading_.state = State::running;
    if (same_ >= kFrozen_samples) [[unlikely]]
      fail(false);
  }

  [[gnu::noinline]] void go_on(Transfer at) {
    switch (step_) {
      case Step::find:
        return find(at);
      case Step::ask_bank:
        return note_bank(at);
      case Step::select_bank:
        return fail(at == Transfer::lost);
      case Step::start:
        return start(at);
      case Step::release_and_go_on:
        if (at != Transfer::done) return fail(false);
        step_ = Step::sample;
        return;
      default:
        step_ = Step::find;  // released
        pause_ticks_ = kSearch_ticks;
    }
  }
  void find(Transfer at) {
    if (at == Transfer::lost) return fail(true);
    const auto& ids = chip().ids;
    if (at == Transfer::done && std::find(ids.begin(), ids.end(), bus_.bytes()[0]) != ids.end()) {
      step_ = Step::start;
      setting_ = 0;
      found_ = true;
      misses_ = same_ = 0;
      reading_.state = State::starting;
      reading_.count_nradps = chip().count_nradps;
      reading_.temperature_cC = hal::GyroReading::kNoTemperature;
    } else if (at == Transfer::done && chip().bank_register != GyroChip::kNoBanks) {
      step_ = Step::ask_bank;
    } else {
      find_next();
    }
  }
  void find_next() {
    step_ = Step::find;
    if (++candidate_ == kCandidates) fail(false);
  }
  /// A start that failed halfway, or a processor that was restarted in it, leaves the chip where its identity cannot be read.
  void note_bank(Transfer at) {
    if (at == Transfer::lost) return fail(true);
    if (at == Transfer::done && bus_.bytes()[0] == chip().start_bank) {
      step_ = Step::select_bank;
    } else {
      find_next();
    }
  }
  void start(Transfer at) {
    const Setting& setting = chip().start[setting_];
    if (at != Transfer::done && !(at == Transfer::refused && setting.may_be_refused))
      return fail(at == Transfer::lost);
    pause_ticks_ = setting.wait_ms;
    if (++setting_ == chip().start.size()) step_ = Step::sample;
  }

  /// Nothing was heard of the transfer for too long.
  [[gnu::noinline]] void hang() { fail(step_ != Step::release && step_ != Step::release_and_go_on); }
  /// The chip is lost, or none was found. The search begins anew later.
  [[gnu::noinline]] void fail(bool bus_hangs) {
    reading_.state = found_ ? State::failed : State::absent;
    candidate_ = 0;
    if (bus_hangs) return release(Step::release);
    under_way_ = false;
    step_ = Step::find;
    pause_ticks_ = kSearch_ticks;
  }
  void release(Step why) {
    step_ = why;
    under_way_ = true;
    busy_ticks_ = pause_ticks_ = 0;
    bus_.release();
  }

  B& bus_;
  hal::GyroReading reading_;
  Step step_ = Step::find;
  bool under_way_ = false;
  bool fetched_ = false;  // a sample that is not decoded yet
  bool found_ = false;    // since the start of the board
  int pause_ticks_ = kPowerUp_ticks, busy_ticks_ = 0;
  std::size_t candidate_ = 0, setting_ = 0;
  int misses_ = 0, same_ = 0;
};

}  // namespace astro::i2c
