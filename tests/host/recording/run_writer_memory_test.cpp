#include <gtest/gtest.h>
#include <malloc.h>

#include "host/recording/run_writer.hpp"
#include "tests/host/recording/support.hpp"
#include "tests/support/base/bounded.hpp"

// A robot that counts at 1 kHz, seen by a tracker at 240 Hz, is recorded in memory that does not grow with time.
namespace astro::recording {
namespace {

std::size_t bytes_in_use() { return mallinfo2().uordblks + mallinfo2().hblkhd; }

/// What the heap holds at the end of so many seconds, before the file is closed.
std::size_t heap_after(int seconds, const std::filesystem::path& path) {
  RunInfo info;
  info.kind = "free";
  info.parameters = {{"wheel_diameter", 0.084},
                     {"counts_per_motor_rev", 4096},
                     {"gear_numerator", 1},
                     {"gear_denominator", 1},
                     {"b", 0.29}};
  RunWriter writer(path, info);
  std::int64_t next_truth_us = 0;
  for (std::int64_t time_us = 0; time_us < 1'000'000 * std::int64_t{seconds}; time_us += 1000) {
    const double angle_rad = 1e-7 * static_cast<double>(time_us);
    const auto counts = static_cast<std::int32_t>(time_us / 500);
    writer.add(OdometrySample{time_us, std::cos(angle_rad), std::sin(angle_rad), angle_rad, 0.3, 0.1, counts,
                              counts});
    for (; next_truth_us <= time_us; next_truth_us += 4167)
      writer.add(TruthSample{next_truth_us, std::cos(angle_rad), std::sin(angle_rad), angle_rad, true});
  }
  const std::size_t heap = bytes_in_use();
  writer.close(info);
  return heap;
}

TEST(RunWriterMemory, DoesNotGrowButByTheIndexOfTheChunks) {
  if (!astro::support::kMeasuresMemory) GTEST_SKIP() << "the sanitizer has an allocator of its own";
  const support::TempFolder folder;
  const std::size_t brief = heap_after(30, folder / "short.mcap"),
                    longer = heap_after(150, folder / "long.mcap");
  const std::uintmax_t stored = std::filesystem::file_size(folder / "long.mcap");
  std::cout << "  half a minute: " << brief / 1024 << " KiB, five times as long: " << longer / 1024
            << " KiB, on the disk " << stored / 1024 << " KiB\n";
  // For viewers, the end of a file has an index of its chunks, of 1 MiB before they are packed: some 250 bytes a chunk
  // and one or two chunks a second make 2 MB an hour, of which two minutes are 65 KB. A vector that grows holds twice as
  // much at times. The messages of two minutes have 150 MB.
  EXPECT_LE(longer, brief + 150'000);
}

}  // namespace
}  // namespace astro::recording
