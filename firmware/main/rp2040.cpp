#include "firmware/app/robot.hpp"
#include "hal/rp2040/board.hpp"

namespace {

using astro::rp2040::Board;

astro::Robot<Board>* ticking = nullptr;

}  // namespace

int main() {
  static Board board;
  static astro::Robot<Board> robot(board);
  ticking = &robot;
  astro::rp2040::Tick::start([] { ticking->tick(); });
  while (true) {
    robot.poll();
    // Every interrupt ends it; the tick is one, so nothing that came in after poll() waits longer than 1 ms.
    asm volatile("wfi" ::: "memory");
  }
}
