#include "hal/mock/board.hpp"
#include "tests/contract/board_contract.hpp"
#include "tests/contract/io_contract.hpp"

namespace astro::contract {
namespace {

class MockRig {
 public:
  mock::Board& board() { return board_; }
  void pass_ms(int ms) { board_.clock().time_us += static_cast<std::uint64_t>(ms) * 1000; }
  void set_counts(hal::EncoderCounts counts) { board_.encoders().counts = counts; }
  void turn(hal::EncoderCounts by) {
    hal::EncoderCounts& counts = board_.encoders().counts;
    counts = {sum(counts.left, by.left), sum(counts.right, by.right)};
  }
  Bridge bridge() { return static_cast<Bridge>(board_.motors().state); }
  hal::Duty duty() { return board_.motors().duty; }
  void set_driver_fault(bool fault) { board_.motors().faulted = fault; }
  bool host_send(int port, std::span<const std::uint8_t> bytes) {
    auto& queue = board_.ports().lane(port).to_robot;
    queue.insert(queue.end(), bytes.begin(), bytes.end());
    return true;
  }
  std::vector<std::uint8_t> host_receive(int port) {
    return std::exchange(board_.ports().lane(port).to_host, {});
  }
  std::array<std::uint8_t, 16> other_id() {
    mock::Board other;
    other.system().id[15] = 1;
    return other.system().unique_id();
  }
  std::array<std::uint8_t, 16> restarted_id() { return mock::Board().system().unique_id(); }

 private:
  static std::int32_t sum(std::int32_t a, std::int32_t b) {
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) + static_cast<std::uint32_t>(b));
  }
  mock::Board board_;
};

static_assert(static_cast<int>(Bridge::coast) == static_cast<int>(mock::Bridge::coast));
static_assert(static_cast<int>(Bridge::brake) == static_cast<int>(mock::Bridge::brake));
static_assert(static_cast<int>(Bridge::drive) == static_cast<int>(mock::Bridge::drive));

INSTANTIATE_TYPED_TEST_SUITE_P(Mock, BoardContract, MockRig);
INSTANTIATE_TYPED_TEST_SUITE_P(Mock, IoContract, MockRig);

}  // namespace
}  // namespace astro::contract
