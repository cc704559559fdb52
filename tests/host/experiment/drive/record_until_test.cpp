#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <malloc.h>

#include "host/base/error.hpp"
#include "host/experiment/drive/record_run.hpp"
#include "host/recording/recording_problem.hpp"
#include "host/recording/run_file.hpp"
#include "host/recording/run_writer.hpp"
#include "tests/support/base/bounded.hpp"
#include "tests/support/base/remarks.hpp"
#include "tests/support/robots/desk.hpp"

// Recording what somebody else drives: to the disk as it comes, in memory that does not grow.
namespace astro::experiment {
namespace {

using namespace std::chrono_literals;
using support::Desk;
using support::TemporaryFolder;

enum class SinkProblem { full };

std::size_t bytes_in_use() { return mallinfo2().uordblks + mallinfo2().hblkhd; }

class Streaming : public testing::Test {
 protected:
  /// Records for so long, by the robot's clock, and returns what the heap holds at the end.
  std::size_t heap_after(std::chrono::microseconds duration) {
    const std::uint64_t end_us = desk_.client.device_time_us() + static_cast<std::uint64_t>(duration.count());
    recording::RunWriter writer(folder_.path() / "run.mcap", {});
    const Recorded recorded = record_until(
        desk_.client, desk_.truth,
        {[&](const auto& sample) { writer.add(sample); }, [&](const auto& sample) { writer.add(sample); }},
        [&] { return desk_.client.device_time_us() >= end_us; });
    const std::size_t heap = bytes_in_use();
    writer.close({});
    EXPECT_NEAR(static_cast<double>(recorded.odometry), static_cast<double>(duration.count()) / 10'000, 20);
    EXPECT_GT(recorded.truth, recorded.odometry / 2);
    return heap;
  }
  std::filesystem::path path() const { return folder_.path() / "run.mcap"; }

  Desk desk_{sim::Config{}};
  TemporaryFolder folder_;
};

TEST_F(Streaming, OfTwentyMinutesTakesNoMoreMemoryThanThatOfOne) {
  if (!support::kMeasuresMemory) GTEST_SKIP() << "the sanitizer has an allocator of its own";
  const std::size_t one = heap_after(1min), twenty = heap_after(20min);
  std::cout << "  a minute: " << one / 1024 << " KiB, twenty: " << twenty / 1024 << " KiB, on the disk "
            << std::filesystem::file_size(path()) / 1024 << " KiB\n";
  // The index at the end of the file takes some 160 bytes for each chunk of 2 s: 0.1 MB in twenty minutes, 7
  // MB a day. The samples of twenty minutes would take 10 MB.
  EXPECT_LE(twenty, one + (std::size_t{1} << 18));
}

TEST_F(Streaming, GivesTheSameRunAsItIsReadBack) {
  heap_after(10s);
  const recording::Run run = recording::read_run(path());
  EXPECT_FALSE(run.warning);
  ASSERT_GT(run.odometry.size(), 990U);
  ASSERT_GT(run.truth.size(), 550U);  // the cameras see 60 poses a second
  EXPECT_GE(run.truth.front().time_us, run.odometry.front().time_us);
  EXPECT_LE(run.truth.back().time_us, run.odometry.back().time_us);
  EXPECT_NEAR(static_cast<double>(run.truth.back().time_us - run.odometry.back().time_us), 0, 100'000);
  for (std::size_t i = 1; i < run.truth.size(); ++i)
    ASSERT_LT(run.truth[i - 1].time_us, run.truth[i].time_us);
}

TEST_F(Streaming, OfAProcessThatWasKilledOnlyTheLastTwoSecondsAreMissing) {
  const std::uint64_t end_us = desk_.client.device_time_us() + 60'000'000;
  // A child that ends without a word: what it had not given to the system is lost, as after SIGKILL.
  const pid_t child = fork();
  if (child == 0) {
    recording::RunWriter writer(path(), {});
    record_until(desk_.client, desk_.truth,
                 {[&](const auto& sample) {
                    writer.add(sample);
                    if (static_cast<std::uint64_t>(sample.time_us) >= end_us) _exit(7);
                  },
                  [&](const auto& sample) { writer.add(sample); }},
                 [] { return false; });
    _exit(1);
  }
  int status = 0;
  waitpid(child, &status, 0);
  ASSERT_EQ(WEXITSTATUS(status), 7);
  EXPECT_FALSE(std::filesystem::exists(path()));
  std::filesystem::rename(path().string() + ".part", path());
  const recording::Run run = recording::read_run(path());
  ASSERT_TRUE(run.warning);
  EXPECT_THAT(*run.warning, support::Tells(recording::RecordingProblem::cut_off, path().string()));
  EXPECT_GE(run.odometry.back().time_us, static_cast<std::int64_t>(end_us) - 2'000'000);
}

TEST_F(Streaming, AFullDiskIsToldAsThatAndNotAsALostLink) {
  int samples = 0;
  const auto record = [&] {
    record_until(desk_.client, desk_.truth,
                 {[&](const auto&) {
                    if (++samples == 100) throw Error("the disk is full", SinkProblem::full);
                  },
                  [](const auto&) {}},
                 [] { return false; });
  };
  EXPECT_THAT(record, support::ThrowsTelling(SinkProblem::full));
  EXPECT_EQ(samples, 100) << "nothing is handed to what has failed";
}

}  // namespace
}  // namespace astro::experiment
