#include <gmock/gmock.h>

#include "host/base/files.hpp"
#include "host/formats/files/mcap_reader.hpp"
#include "host/recording/recording_problem.hpp"
#include "host/recording/run_file.hpp"
#include "host/recording/run_writer.hpp"
#include "tests/host/recording/support.hpp"
#include "tests/support/base/remarks.hpp"

namespace astro::recording {
namespace {

using astro::support::Tells;
using astro::support::told_by;
using support::TempFolder;
using ::testing::Not;

/// A small run in many chunks: every odometry sample closes one.
Run small_run() {
  recording::Run run;
  run.info.kind = "line";
  for (int i = 0; i < 6; ++i) {
    run.odometry.push_back({1'000'000 * i, 0.1 * i, 0, 0.01 * i, 0.1, 0, 100 * i, 100 * i});
  }
  return run;
}

Bytes small_file(const TempFolder& folder) {
  const recording::Run run = small_run();
  RunWriter writer(folder / "whole.mcap", run.info, {1, 1});
  for (const OdometrySample& sample : run.odometry) writer.add(sample);
  writer.close(run.info);
  return load_file(folder / "whole.mcap");
}

TEST(DamagedRun, CutAtEveryByteItIsRefusedOrGivesAPrefixWithAWarning) {
  const TempFolder folder;
  const recording::Run run = small_run();
  const Bytes file = small_file(folder);
  std::size_t kept = 0;
  for (std::size_t size = 0; size < file.size(); ++size) {
    recording::Run cut;
    if (!told_by([&] { cut = run_from_bytes(ByteView(file).first(size), "cut.mcap"); }).sentence.empty()) {
      EXPECT_EQ(kept, 0U) << "once the run record stands in the file it reads, at " << size;
      continue;
    }
    EXPECT_THAT(cut.warning.value_or(Remark{}), Tells(RecordingProblem::cut_off, "cut.mcap")) << size;
    EXPECT_EQ(cut.info.kind, "line");
    EXPECT_GE(cut.odometry.size(), kept) << size;
    kept = cut.odometry.size();
    for (std::size_t i = 0; i < kept; ++i) {
      EXPECT_EQ(cut.odometry[i].time_us, run.odometry[i].time_us) << size;
      EXPECT_EQ(cut.odometry[i].right_counts, run.odometry[i].right_counts) << size;
    }
  }
  EXPECT_EQ(kept, run.odometry.size());
}

TEST(DamagedRun, AFlippedBitIsNeverReadSilently) {
  const TempFolder folder;
  Bytes file = small_file(folder);
  for (std::size_t at = 0; at < file.size(); ++at) {
    const auto flip = static_cast<std::uint8_t>(1 << (at % 8));
    file[at] ^= flip;
    recording::Run run;
    const Remark error = told_by([&] { run = run_from_bytes(file, "flipped.mcap"); });
    file[at] ^= flip;
    EXPECT_TRUE(!error.sentence.empty() || run.warning) << "byte " << at;
    if (!error.sentence.empty()) {
      EXPECT_THAT(error.values, testing::Contains("flipped.mcap")) << "byte " << at;
    }
  }
}

TEST(DamagedRun, WhoseEndIsThereIsCalledDamagedAndNeverCutOff) {
  const TempFolder folder;
  const Bytes file = small_file(folder);
  // Every byte, lengths of records included, except the last 8, which are the end mark.
  for (std::size_t at = 8; at < file.size() - 8; ++at)
    for (const std::uint8_t flip : {std::uint8_t{0x01}, std::uint8_t{0x80}}) {
      Bytes bad = file;
      bad[at] ^= flip;
      EXPECT_THAT([&] { run_from_bytes(bad, "flipped.mcap"); },
                  testing::Throws<DamagedRecording>(
                      testing::AllOf(testing::Property(&Error::kind, Not(Kind(bag::McapProblem::cut_off))),
                                     testing::Property(&Error::values, testing::Contains("flipped.mcap")))))
          << "byte " << at;
    }
}

TEST(DamagedRun, IsReadAsFarAsItGoesIfThatIsWanted) {
  const TempFolder folder;
  const recording::Run run = small_run();
  Bytes file = small_file(folder);
  int read = 0;
  for (std::size_t at = file.size() / 4; at < file.size() / 2; ++at) {
    file[at] ^= 0x10;
    try {
      const recording::Run some = run_from_bytes(file, "flipped.mcap", Damage::accepted);
      ++read;
      const Remark warning = some.warning.value_or(Remark{});
      EXPECT_NE(warning.kind, Kind(RecordingProblem::cut_off)) << "byte " << at;
      EXPECT_THAT(warning.values, testing::Contains("flipped.mcap")) << "byte " << at;
      for (const OdometrySample& sample : some.odometry) {
        const auto i = static_cast<std::size_t>(sample.time_us / 1'000'000);
        EXPECT_EQ(sample.x_m, run.odometry[i].x_m) << "byte " << at;
        EXPECT_EQ(sample.left_counts, run.odometry[i].left_counts) << "byte " << at;
      }
    } catch (const Error&) {  // the record that makes it a run may be damaged
    }
    file[at] ^= 0x10;
  }
  EXPECT_GT(read, 0);
}

}  // namespace
}  // namespace astro::recording
