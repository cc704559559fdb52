#include <benchmark/benchmark.h>

#include "common/fixed/trig.hpp"
#include "common/kinematics/odometry.hpp"
#include "firmware/app/tick/drive.hpp"

// What one control tick costs on this machine, by part. Instructions on the microcontroller are counted
// elsewhere.
namespace {

using namespace astro;

/// Wheels that turn as commanded, in whole counts.
class IdealWheels {
 public:
  TickInput next(const Drive& drive) {
    constexpr double kCountsPerMetre = 2803.2 / 0.22619467105846508;
    left_ += drive.wheels().set_points().left_umps * 1e-9 * kCountsPerMetre;
    right_ += drive.wheels().set_points().right_umps * 1e-9 * kCountsPerMetre;
    now_us_ += 1000;
    return {now_us_, {static_cast<std::int32_t>(left_), static_cast<std::int32_t>(right_)}, 12'000, false};
  }

 private:
  double left_ = 0, right_ = 0;
  std::uint64_t now_us_ = 0;
};

/// Armed, after the ticks that prove the rate.
void get_ready(Drive& drive, IdealWheels& wheels) {
  while (!drive.arm()) drive.advance(wheels.next(drive));
}

void tick_at_rest(benchmark::State& state) {
  Drive drive{ParameterSet{}};
  IdealWheels wheels;
  for (auto _ : state) benchmark::DoNotOptimize(drive.advance(wheels.next(drive)));
}
BENCHMARK(tick_at_rest);

void tick_of_a_velocity(benchmark::State& state) {
  Drive drive{ParameterSet{}};
  IdealWheels wheels;
  get_ready(drive, wheels);
  for (auto _ : state) {
    drive.drive_velocity({300'000, 200'000});
    benchmark::DoNotOptimize(drive.advance(wheels.next(drive)));
  }
}
BENCHMARK(tick_of_a_velocity);

void tick_of_a_segment(benchmark::State& state) {
  Drive drive{ParameterSet{}};
  IdealWheels wheels;
  get_ready(drive, wheels);
  for (auto _ : state) {
    drive.host_seen();
    if (drive.queued() == 0) drive.add_segment({.length_nm = 1'000'000'000}, 1);
    drive.plan();
    while (!drive.events().empty()) drive.events().pop();
    benchmark::DoNotOptimize(drive.advance(wheels.next(drive)));
  }
}
BENCHMARK(tick_of_a_segment);

void odometry(benchmark::State& state) {
  Odometry odometry(make_geometry(ParameterSet{}));
  for (auto _ : state) {
    odometry.advance(5, 6, {});
    benchmark::DoNotOptimize(odometry.pose());
  }
}
BENCHMARK(odometry);

void sine_and_cosine(benchmark::State& state) {
  std::uint64_t angle = 0;
  for (auto _ : state) benchmark::DoNotOptimize(sin_cos(Angle::from_raw(angle += 0x9E37'79B9'7F4A'7C15U)));
}
BENCHMARK(sine_and_cosine);

}  // namespace

BENCHMARK_MAIN();
