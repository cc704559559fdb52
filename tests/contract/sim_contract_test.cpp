#include <numbers>

#include "hal/sim/board.hpp"
#include "tests/contract/board_contract.hpp"
#include "tests/contract/gyro_contract.hpp"
#include "tests/contract/io_contract.hpp"

namespace astro::contract {
namespace {

class SimRig {
 public:
  SimRig() {
    // Half a count in, so that turning by whole counts is not decided by rounding.
    turn_counts(0.5, 0.5);
  }
  sim::Board& board() { return board_; }
  void pass_ms(int ms) {
    for (int i = 0; i < ms; ++i) {
      board_.kick(turning_radps_ * 1e-3);
      board_.advance_tick();
    }
  }
  void turn_body(double rate_radps) { turning_radps_ = rate_radps; }
  void plug_gyro(bool plugged) {
    board_.gyro().set_fault(plugged ? sim::GyroFault::none : sim::GyroFault::unplugged);
  }
  std::size_t up() { return 2; }
  void set_counts(hal::EncoderCounts counts) { board_.encoders().preset(counts); }
  void turn(hal::EncoderCounts by) { turn_counts(by.left, by.right); }
  Bridge bridge() { return static_cast<Bridge>(board_.motors().state()); }
  hal::Duty duty() { return board_.motors().duty(); }
  void set_driver_fault(bool fault) { board_.motors().set_fault(fault); }
  bool host_send(int port, std::span<const std::uint8_t> bytes) {
    return board_.ports().host_write(port, bytes) == bytes.size();
  }
  std::vector<std::uint8_t> host_receive(int port) {
    std::vector<std::uint8_t> bytes(sim::ByteQueue::kCapacity);
    bytes.resize(board_.ports().host_read(port, bytes));
    return bytes;
  }
  std::array<std::uint8_t, 16> other_id() {
    sim::Config config;
    config.seed = 2;
    return sim::Board(config).system().unique_id();
  }
  std::array<std::uint8_t, 16> restarted_id() {
    board_.restart(hal::ResetCause::software);
    return board_.system().unique_id();
  }

 private:
  void turn_counts(double left, double right) {
    const sim::Config nominal;
    const double rad = 2.0 * std::numbers::pi / (nominal.counts_per_motor_rev * nominal.gear_ratio);
    board_.encoders().turn({left * rad, right * rad});
  }
  static sim::Config with_gyro() {
    sim::Config config;
    config.gyro.emplace();
    return config;
  }
  sim::Board board_{with_gyro()};
  double turning_radps_ = 0;
};

static_assert(static_cast<int>(Bridge::coast) == static_cast<int>(sim::Bridge::coast));
static_assert(static_cast<int>(Bridge::brake) == static_cast<int>(sim::Bridge::brake));
static_assert(static_cast<int>(Bridge::drive) == static_cast<int>(sim::Bridge::drive));

INSTANTIATE_TYPED_TEST_SUITE_P(Sim, BoardContract, SimRig);
INSTANTIATE_TYPED_TEST_SUITE_P(Sim, IoContract, SimRig);
INSTANTIATE_TYPED_TEST_SUITE_P(Sim, GyroContract, SimRig);

}  // namespace
}  // namespace astro::contract
