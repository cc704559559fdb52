#include <gtest/gtest.h>

#include <functional>
#include <random>

#include "host/formats/files/db3_writer.hpp"
#include "host/import/drives/file_inspection.hpp"
#include "host/recording/run_writer.hpp"
#include "tests/host/import/drives/file_samples.hpp"
#include "tests/support/base/bounded.hpp"
#include "tests/support/base/temporary_folder.hpp"

// What is in a bag of any size is told in constant memory.
namespace astro::importing {
namespace {

namespace fs = std::filesystem;
using support::measured;
using support::Taken;

class InspectionMemory : public testing::Test {
 protected:
  /// Numbers that do not pack, as the last digits of a tracker.
  double noise() { return 0x1p-63 * static_cast<double>(random_()) - 1; }
  Bytes transform(std::int64_t time_ns) {
    return ros2::encode_tf({{time_ns, "map", "robot", noise(), noise(), noise(), 0, 0, noise(), noise()}});
  }
  fs::path at(const std::string& name) const { return folder_.path() / name; }

  /// `write` makes a file of at least so many bytes. The larger one may take no more memory than the smaller one, but for
  /// what the allocator leaves.
  void expect_same(const std::function<fs::path(std::size_t bytes)>& write, std::size_t small_bytes,
                   std::size_t large_bytes) {
    const fs::path small = write(small_bytes), large = write(large_bytes);
    ASSERT_GE(fs::file_size(large), large_bytes);
    const Taken of_small = measured([&] { inspect_file(small); });
    const Taken of_large = measured([&] { inspect_file(large); });
    EXPECT_TRUE(of_small.ended && of_large.ended);
    EXPECT_EQ(of_small.complaint + of_large.complaint, "");
    if (support::kMeasuresMemory) {
      EXPECT_LE(of_large.peak_bytes, of_small.peak_bytes + (std::size_t{2} << 20));
    }
  }

  std::mt19937_64 random_{1};
  const test::TemporaryFolder folder_;
};

TEST_F(InspectionMemory, OfAnMcapBagDoesNotGrowWithTheFile) {
  for (const std::string compression : {"", "zstd"})
    expect_same(
        [&](std::size_t bytes) {
          test::McapBag bag(compression);
          bag.topic(1, "/tf", test::kTfType);
          for (std::int64_t i = 0; bag.file().size() < bytes; ++i) {
            bag.message(1, i, transform(i));
            if (bag.open_bytes() > (std::size_t{1} << 20)) bag.end_chunk();
          }
          const fs::path path = at(compression + std::to_string(bytes) + ".mcap");
          test::save(path, bag.closed());
          return path;
        },
        std::size_t{4} << 20, std::size_t{32} << 20);
}

TEST_F(InspectionMemory, OfARos1BagDoesNotGrowWithTheFile) {
  for (const std::string compression : {"none", "lz4"})
    expect_same(
        [&](std::size_t bytes) {
          support::Ros1Bag bag(compression);
          bag.topic(1, "/tf", "tf/tfMessage", support::ros1::kTf);
          for (std::int64_t i = 0; bag.file().size() < bytes; ++i) {
            const ros2::msg::TransformStamped transform{
                test::header_at(i), "robot", {{noise(), noise(), noise()}, {0, 0, noise(), noise()}}};
            bag.message(1, i, support::Ros1Message::encode(ros2::msg::TFMessage{{transform}}));
            if (bag.open_bytes() > (std::size_t{1} << 19)) bag.end_chunk();
          }
          const fs::path path = at(compression + std::to_string(bytes) + ".bag");
          test::save(path, bag.closed());
          return path;
        },
        std::size_t{2} << 20, std::size_t{12} << 20);
}

TEST_F(InspectionMemory, OfADatabaseDoesNotGrowWithTheFile) {
  expect_same(
      [&](std::size_t bytes) {
        const fs::path path = at("bag" + std::to_string(bytes));
        bag::Db3Writer bag(path);
        const int topic = bag.add_topic("/tf", test::kTfType, "");
        for (std::size_t i = 0; i < bytes / 112; ++i) {
          const auto time_ns = static_cast<std::int64_t>(i);
          bag.write(topic, time_ns, transform(time_ns));
        }
        bag.close();
        return path / (path.filename().string() + "_0.db3");
      },
      std::size_t{8} << 20, std::size_t{64} << 20);
}

TEST_F(InspectionMemory, OfOurRecordingDoesNotGrowWithTheFile) {
  expect_same(
      [&](std::size_t bytes) {
        const fs::path path = at("own" + std::to_string(bytes) + ".mcap");
        recording::RunInfo info;
        info.kind = "free";
        recording::RunWriter writer(path, info);
        for (std::size_t i = 0; i < bytes / 64; ++i)
          writer.add(recording::OdometrySample{static_cast<std::int64_t>(1000 * i), noise(), noise(), noise(),
                                               noise(), noise(), static_cast<std::int32_t>(i), 0});
        writer.close(info);
        return path;
      },
      std::size_t{1} << 20, std::size_t{8} << 20);
}

}  // namespace
}  // namespace astro::importing
