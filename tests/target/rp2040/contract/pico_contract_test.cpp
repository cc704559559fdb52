#include <cmath>
#include <cstdlib>

#include "tests/contract/board_contract.hpp"
#include "tests/contract/io_contract.hpp"
#include "tests/target/rp2040/contract/pico_puppet.hpp"

/// The contract of hal/interface on the drivers of the Pico, run by the emulated chip.
namespace astro::contract {
namespace {

template <bool kUsb>
class PicoRig {
  using Puppet = target::PicoPuppet<kUsb>;
  using Board = target::PicoBoard<kUsb>;

 public:
  /// Nothing that the firmware did was forbidden by the chip.
  ~PicoRig() { EXPECT_EQ(puppet_.say("complaints")[0], "0"); }

  Board& board() { return board_; }
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
  bool host_send(int port, std::span<const std::uint8_t> bytes) {
    puppet_.say("send " + std::to_string(Puppet::port_of(port)) + ' ' + Puppet::hex(bytes));
    return true;
  }
  std::vector<std::uint8_t> host_receive(int port) {
    pass_ms(30);  // 2 KB at 1 Mbit/s
    return Puppet::bytes_of(puppet_.say("receive " + std::to_string(Puppet::port_of(port)))[0]);
  }
  std::array<std::uint8_t, 16> other_id() {
    target::PicoPuppet<false> other(2);
    return target::PicoBoard<false>(other).system().unique_id();
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

  Puppet puppet_{1};
  Board board_{puppet_};
};

INSTANTIATE_TYPED_TEST_SUITE_P(Rp2040, BoardContract, PicoRig<false>);
INSTANTIATE_TYPED_TEST_SUITE_P(Rp2040, IoContract, PicoRig<false>);
INSTANTIATE_TYPED_TEST_SUITE_P(Rp2040Usb, IoContract, PicoRig<true>);

}  // namespace
}  // namespace astro::contract
