#include <cmath>
#include <cstdlib>

#include "tests/contract/board_contract.hpp"
#include "tests/contract/io_contract.hpp"
#include "tests/target/rp2040/contract/pico_puppet.hpp"

/// The contract of hal/interface on the drivers of the Pico, run by the emulated chip.
namespace astro::contract {
namespace {

class PicoRig {
 public:
  /// Nothing that the firmware did was forbidden by the chip.
  ~PicoRig() { EXPECT_EQ(puppet_.say("complaints")[0], "0"); }

  target::PicoBoard& board() { return board_; }
  void pass_ms(int ms) { puppet_.say("pass " + std::to_string(ms)); }
  void set_counts(hal::EncoderCounts counts) { puppet_.say("counts " + both(counts)); }
  void turn(hal::EncoderCounts by) { puppet_.say("turn " + both(by)); }
  Bridge bridge() {
    pass_ms(1);  // the PWM takes new values when its period ends
    const auto states = puppet_.say("bridges");
    if (states[0] == "coast" && states[1] == "coast") return Bridge::coast;
    return states[0] == "brake" && states[1] == "brake" ? Bridge::brake : Bridge::drive;
  }
  hal::Duty duty() {
    const auto states = puppet_.say("bridges");
    return {on_grid(std::stod(states[0]), board_.motors().asked.left),
            on_grid(std::stod(states[1]), board_.motors().asked.right)};
  }
  void set_driver_fault(bool fault) { puppet_.say(fault ? "fault 1" : "fault 0"); }
  bool host_send(int, std::span<const std::uint8_t> bytes) {
    puppet_.say("send " + target::PicoPuppet::hex(bytes));
    return true;
  }
  std::vector<std::uint8_t> host_receive(int) {
    pass_ms(30);  // 2 KB at 1 Mbit/s
    return target::PicoPuppet::bytes_of(puppet_.say("receive")[0]);
  }
  std::array<std::uint8_t, 16> other_id() {
    target::PicoPuppet other(2);
    return target::PicoBoard(other).system().unique_id();
  }
  std::array<std::uint8_t, 16> restarted_id() {
    puppet_.say("restart");
    return board_.system().unique_id();
  }

 private:
  static std::string both(hal::EncoderCounts counts) {
    return std::to_string(counts.left) + ' ' + std::to_string(counts.right);
  }
  static std::int16_t on_grid(double duty, std::int16_t asked) {
    constexpr double kHalfCount = 0.5 / 6250;
    if (std::abs(duty - asked / 32767.0) <= kHalfCount) return asked;
    return static_cast<std::int16_t>(std::lround(duty * 32767));
  }

  target::PicoPuppet puppet_{1};
  target::PicoBoard board_{puppet_};
};

INSTANTIATE_TYPED_TEST_SUITE_P(Rp2040, BoardContract, PicoRig);
INSTANTIATE_TYPED_TEST_SUITE_P(Rp2040, IoContract, PicoRig);

}  // namespace
}  // namespace astro::contract
