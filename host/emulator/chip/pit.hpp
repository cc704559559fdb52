#pragma once

#include <array>
#include <cstdint>

#include "host/emulator/chip/clocks.hpp"

namespace astro::emulator {

/// What a timer cannot do. The value is its channel's number; of count_written the offset of the register.
enum class PitProblem { nothing_to_chain_to, module_stopped, chained_while_counting, count_written };

/// Four timers that count down to zero and restart at LDVAL. Each counts by the module's clock, or is chained
/// to the timer before it and counts that timer's periods. The first two, read as one, are the lifetime
/// timer. Its upper half changes one count after its lower half has restarted.
class Pit : public Model {
 public:
  Pit(Machine& machine, const Ccm& ccm) : machine_(machine), ccm_(ccm) {}

  std::uint32_t read(std::uint32_t offset) override;
  void write(std::uint32_t offset, std::uint32_t value) override;
  void event() override;
  void reset() override;

  /// Time since channel 0 was started; 0 before.
  std::uint64_t lifetime_us() const;
  /// Makes the lifetime timer older by this many counts.
  void age(std::uint64_t counts);

 private:
  struct Channel {
    std::uint32_t load = 0, control = 0;
    std::uint32_t count = 0;  // of a chained or stopped channel
    bool flag = false, began_anew = false;
    Cycles began = 0;
    Cycles due = kNever;  // the end of the period, if it counts by the module's clock
  };

  Cycles cycles_per_count() const;
  std::uint32_t current(const Channel& channel) const;
  void set_stopped(bool stopped);
  void set_control(std::size_t n, std::uint32_t value);
  void begin_period(Channel& channel, Cycles at);
  void end_period(std::size_t n);
  void catch_up();
  void update();

  Machine& machine_;
  const Ccm& ccm_;
  std::array<Channel, 4> channels_{};
  bool stopped_ = true;
  std::uint32_t held_low_ = 0;
};

}  // namespace astro::emulator
