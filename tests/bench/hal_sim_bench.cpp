#include <benchmark/benchmark.h>

#include "hal/sim/board.hpp"

// Cost of one simulated millisecond, apart from the firmware. The bar for the whole robot, firmware included,
// is 333 ns (3000x real time); the plant may take 120 ns of it.
namespace astro::sim {
namespace {

void run(benchmark::State& state, Board& board, hal::Duty even, hal::Duty odd) {
  bool toggle = false;
  for (auto _ : state) {
    board.motors().drive((toggle = !toggle) ? even : odd);
    board.advance_tick();
    benchmark::DoNotOptimize(board.encoders().read());
  }
  state.counters["x_real_time"] = benchmark::Counter(1e-3, benchmark::Counter::kIsIterationInvariantRate);
}

void drive_straight(benchmark::State& state) {
  Board board(Config{});
  run(state, board, {18000, 18000}, {18010, 18005});
}
BENCHMARK(drive_straight);

void on_stand(benchmark::State& state) {
  Config config;
  config.on_stand = true;
  Board board(config);
  run(state, board, {18000, 18000}, {18010, 18005});
}
BENCHMARK(on_stand);

void without_slip(benchmark::State& state) {
  Config config;
  config.slip_m = 0;
  Board board(config);
  run(state, board, {18000, 18000}, {18010, 18005});
}
BENCHMARK(without_slip);

void spin(benchmark::State& state) {
  Board board(Config{});
  run(state, board, {-9000, 9000}, {-9010, 9005});
}
BENCHMARK(spin);

void pivot_on_one_wheel(benchmark::State& state) {
  Board board(Config{});
  run(state, board, {0, 9000}, {0, 9005});
}
BENCHMARK(pivot_on_one_wheel);

void press_on_wall(benchmark::State& state) {
  Config config;
  config.wall = WallConfig{.x_m = 0.1625};
  Board board(config);
  run(state, board, {4000, 4000}, {4010, 4005});
}
BENCHMARK(press_on_wall);

void at_rest(benchmark::State& state) {
  Board board(Config{});
  run(state, board, {0, 0}, {0, 0});
}
BENCHMARK(at_rest);

}  // namespace
}  // namespace astro::sim

BENCHMARK_MAIN();
