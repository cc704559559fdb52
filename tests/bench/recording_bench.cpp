// An hour of a robot that counts at 1 kHz under a tracker at 240 Hz, recorded by the writer of `record`, and inspected:
// how many times faster than real time on one core, and the memory that it takes. Then bags of 1 GB of other programs,
// inspected. Fails if a bar is missed.
//   recording_speed [MINUTES [MEGABYTES]]

#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <random>

#include "host/formats/files/db3_writer.hpp"
#include "host/formats/files/mcap_writer.hpp"
#include "host/formats/messages/stamped_pose.hpp"
#include "host/import/drives/file_inspection.hpp"
#include "host/recording/run_writer.hpp"

namespace {

using namespace astro;
namespace fs = std::filesystem;

struct Cost {
  double cpu_s = 0, memory_mb = 0;
};

/// What `work` takes in a process of its own; the memory is that of the whole process.
Cost cost_of(const std::function<void()>& work) {
  const pid_t child = fork();
  if (child == 0) {
    work();
    _exit(0);
  }
  rusage usage{};
  int status = 0;
  wait4(child, &status, 0, &usage);
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) throw std::runtime_error("the work failed");
  return {static_cast<double>(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
              1e-6 * static_cast<double>(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec),
          static_cast<double>(usage.ru_maxrss) / 1024};
}

double megabytes(const fs::path& path) { return 1e-6 * static_cast<double>(fs::file_size(path)); }

void record(const fs::path& path, int minutes) {
  recording::RunInfo info;
  info.kind = "free";
  info.parameters = {{"wheel_diameter", 0.084},
                     {"counts_per_motor_rev", 4096},
                     {"gear_numerator", 1},
                     {"gear_denominator", 1},
                     {"b", 0.29}};
  recording::RunWriter writer(path, info);
  std::mt19937_64 random(1);
  std::normal_distribution<double> noise_m(0, 1e-4);
  std::int64_t next_truth_us = 0;
  for (std::int64_t time_us = 0; time_us < 60'000'000 * std::int64_t{minutes}; time_us += 1000) {
    const double s = 1e-6 * static_cast<double>(time_us), theta_rad = std::sin(0.3 * s);
    const auto left = static_cast<std::int32_t>(1500 * s + 300 * theta_rad),
               right = static_cast<std::int32_t>(1500 * s);
    writer.add(recording::OdometrySample{time_us, 2 * std::cos(0.1 * s), 2 * std::sin(0.1 * s), theta_rad,
                                         0.2, 0.3 * std::cos(0.3 * s), left, right});
    for (; next_truth_us <= time_us; next_truth_us += 4167)
      writer.add(recording::TruthSample{next_truth_us, 2 * std::cos(0.1 * s) + noise_m(random),
                                        2 * std::sin(0.1 * s) + noise_m(random), theta_rad, true});
  }
  writer.close(info);
}

Bytes transform(std::int64_t time_ns, std::mt19937_64& random) {
  const double noise = std::normal_distribution(0.0, 1e-4)(random);
  return ros2::encode_tf({{time_ns, "map", "robot", 1 + noise, 2 - noise, noise, 0, 0, noise, 1}});
}

void write_mcap(const fs::path& path, double least_mb) {
  PartFile file(path);
  double written_mb = 0;
  bag::McapWriter writer(
      [&](ByteView bytes) {
        file.write(bytes);
        written_mb += 1e-6 * static_cast<double>(bytes.size());
      },
      {"ros2", "bench"});
  const auto channel =
      writer.add_channel(writer.add_schema(ros2::tf_message_type().name, "ros2msg", ""), "/tf", "cdr", {});
  std::mt19937_64 random(1);
  for (std::int64_t time_ns = 0; written_mb < least_mb; time_ns += 4'166'667)
    writer.write(channel, static_cast<std::uint64_t>(time_ns), transform(time_ns, random));
  writer.close();
  file.commit();
}

void write_database(const fs::path& folder, double least_mb) {
  bag::Db3Writer bag(folder);
  const int topic = bag.add_topic("/tf", ros2::tf_message_type().name, "");
  std::mt19937_64 random(1);
  constexpr double kRowBytes = 134;  // with its cell in the index
  std::int64_t time_ns = 0;
  for (double written_mb = 0; written_mb < least_mb; written_mb += 1e-6 * kRowBytes, time_ns += 4'166'667)
    bag.write(topic, time_ns, transform(time_ns, random));
  bag.close();
}

/// Prints the cost of inspecting the file; whether it is within the bar on memory.
bool inspects(const char* what, const fs::path& path) {
  constexpr double kBar_mb = 64;
  const Cost cost = cost_of([&] { importing::inspect_file(path); });
  fmt::print("inspect {:22} {:6.0f} MB: {:5.1f} s, {:.0f} MB of memory (bar {:.0f})\n", what, megabytes(path),
             cost.cpu_s, cost.memory_mb, kBar_mb);
  return cost.memory_mb <= kBar_mb;
}

}  // namespace

int main(int count, char** arguments) {
  const int minutes = count > 1 ? std::atoi(arguments[1]) : 60;
  const double bag_mb = count > 2 ? std::atof(arguments[2]) : 1000;
  const fs::path folder = fs::temp_directory_path() / fmt::format("astro-recording-bench-{}", getpid());
  const fs::path run = folder / "run.mcap", mcap = folder / "x.mcap", database = folder / "bag";

  const Cost one = cost_of([&] { record(folder / "one.mcap", 1); });
  const Cost cost = cost_of([&] { record(run, minutes); });
  const double times = 60 * minutes / cost.cpu_s;
  fmt::print(
      "record {} min of 1 kHz counts and 240 Hz truth: {:.0f} x real time (bar 10), {:.0f} MB on the disk, "
      "{:.0f} MB of "
      "memory ({:.0f} MB for one minute)\n",
      minutes, times, megabytes(run), cost.memory_mb, one.memory_mb);
  // The index of the chunks at the end of the file: some 250 bytes for each second or less.
  bool good = times >= 10 && cost.memory_mb <= one.memory_mb + 8;
  good = inspects("our recording", run) && good;

  cost_of([&] { write_mcap(mcap, bag_mb); });
  good = inspects("MCAP", mcap) && good;
  fs::remove(mcap);
  cost_of([&] { write_database(database, bag_mb); });
  good = inspects("db3", database / "bag_0.db3") && good;
  fs::remove_all(folder);
  return good ? 0 : 1;
}
