#include <benchmark/benchmark.h>

#include <cmath>
#include <string>

#include "host/truth/files/tracker_file.hpp"
#include "host/truth/floor/floor_path.hpp"
#include "host/truth/floor/inspection.hpp"

// How fast recordings of trackers are read: some 16 MiB of each format, as the programs write their numbers. The bar
// is 50 MB/s on one core.
namespace {

using namespace astro;

std::string numbers(double time_s, int count, char separator, int decimals) {
  std::string text;
  for (int i = 0; i < count; ++i) {
    char cell[32];
    std::snprintf(cell, sizeof cell, "%.*f", decimals, std::sin(0.3 * time_s + i));
    text += separator;
    text += cell;
  }
  return text;
}

/// A row for each frame at 100 Hz until the text is long enough.
template <class Row>
std::string rows(std::string text, Row row) {
  for (int frame = 0; text.size() < (std::size_t{16} << 20); ++frame) text += row(frame, 0.01 * frame);
  return text;
}

std::string times(const char* cell, int count) {
  std::string text;
  for (int i = 0; i < count; ++i) text += cell;
  return text;
}

/// `markers`: columns of markers behind the body's own.
std::string motive(const char* rotation, int angles, int markers) {
  std::string head = std::string("Format Version,1.23,Export Frame Rate,100.000000,Rotation Type,") +
                     rotation + ",Length Units,Meters\n\n,Type" + times(",Rigid Body", angles + 3) +
                     times(",Marker", 3 * markers) + "\n,Name" + times(",astro", angles + 3) +
                     times(",loose", 3 * markers) + "\n,ID" + times(",\"4C\"", angles + 3) +
                     times(",\"5A\"", 3 * markers) + "\n," + times(",Rotation", angles) +
                     times(",Position", 3 + 3 * markers) + "\nFrame,Time (Seconds),X,Y,Z" +
                     (angles == 4 ? ",W" : "") + times(",X,Y,Z", 1 + markers) + "\n";
  return rows(std::move(head), [&](int frame, double time_s) {
    char start[48];
    std::snprintf(start, sizeof start, "%d,%.6f", frame, time_s);
    return start + numbers(time_s, angles + 3 + 3 * markers, ',', 6) + "\r\n";
  });
}

std::string vicon() {
  return rows(
      "Objects\n100\n,,Global Angle a:a,,,,,\nFrame,Sub Frame,RX,RY,RZ,TX,TY,TZ\n,,rad,rad,rad,mm,mm,mm\n",
      [](int frame, double t) { return std::to_string(frame + 1) + ",0" + numbers(t, 6, ',', 6) + "\r\n"; });
}

std::string tum() {
  return rows("# timestamp tx ty tz qx qy qz qw\n", [](int frame, double t) {
    return std::to_string(1'700'000'000 + frame) + ".123456789" + numbers(t, 6, ' ', 9) + " 0.5\n";
  });
}

std::string plain() {
  return rows("time_s,x_m,y_m,theta_rad\n",
              [](int, double t) { return std::to_string(t) + numbers(t, 3, ',', 6) + "\n"; });
}

void read(benchmark::State& state, const std::string& text) {
  for (auto _ : state) benchmark::DoNotOptimize(truth::read_track(text, "x"));
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(text.size()));
}
BENCHMARK_CAPTURE(read, motive_quaternions, motive("Quaternion", 4, 0))->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(read, motive_euler, motive("YXZ", 3, 0))->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(read, motive_with_markers, motive("Quaternion", 4, 10))->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(read, vicon, vicon())->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(read, tum, tum())->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(read, plain, plain())->Unit(benchmark::kMillisecond);

/// An hour at 100 Hz.
truth::BodyTrack hour() {
  truth::BodyTrack track;
  track.facts.rotation_kind = truth::RotationKind::quaternion;
  for (int i = 0; i < 360'000; ++i) {
    const double t = 0.01 * i, noise = 1e-4 * std::sin(1e4 * t * t);
    track.samples.push_back({i * std::int64_t{10'000'000},
                             {std::sin(0.1 * t) + noise, std::sin(0.07 * t) - noise, noise / 2, 0, 0,
                              std::sin(0.05 * t), std::cos(0.05 * t)}});
  }
  return track;
}

void inspect_an_hour(benchmark::State& state) {
  const truth::BodyTrack track = hour();
  for (auto _ : state) {
    truth::BodyTrack copy = track;
    benchmark::DoNotOptimize(truth::inspect(copy));
  }
}
BENCHMARK(inspect_an_hour)->Unit(benchmark::kMillisecond);

void place_an_hour(benchmark::State& state) {
  const truth::BodyTrack track = hour();
  for (auto _ : state) benchmark::DoNotOptimize(truth::place_on_floor(track));
}
BENCHMARK(place_an_hour)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
