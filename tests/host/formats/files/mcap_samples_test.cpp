#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <map>

#include "host/base/files.hpp"
#include "host/formats/files/mcap_reader.hpp"
#include "host/formats/messages/ros_messages.hpp"
#include "host/recording/sample_messages.hpp"
#include "tests/support/base/places.hpp"

namespace astro::bag {
namespace {

namespace fs = std::filesystem;

/// Files that other programs wrote, beside a developer's checkout.
class McapSamples : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!fs::is_directory(folder_)) GTEST_SKIP() << "no samples in " << folder_;
  }

  void read(const std::string& name) {
    counts_.clear();
    x_sum_m_ = 0;
    McapHandlers handlers;
    handlers.message = [this](const bag::mcap::Channel& channel, const bag::mcap::Schema* schema,
                              const bag::mcap::Message& message) {
      ++counts_[channel.topic];
      if (schema == nullptr || schema->name != ros2::odometry_type().name) return;
      const auto odometry = recording::decode_odometry(message.data);
      ASSERT_TRUE(odometry);
      x_sum_m_ += odometry->x_m;
      last_ = *odometry;
    };
    report_ = read_mcap(load_file(folder_ / name), handlers);
  }

  const fs::path folder_ = astro::support::shared_data() / "samples/mcap";
  std::map<std::string, int> counts_;
  double x_sum_m_ = 0;
  recording::OdometrySample last_;
  McapReport report_;
};

using Counts = std::map<std::string, int>;

TEST_F(McapSamples, BagsOfRos2ReadWithTheCountsOfTheirMetadata) {
  read("cdr_test/cdr_test_0.mcap");
  EXPECT_EQ(counts_, (Counts{{"/test_topic", 3}, {"/array_topic", 4}}));
  EXPECT_EQ(report_.profile, "ros2");
  EXPECT_TRUE(report_.warnings.empty());
  read("talker/talker.mcap");
  EXPECT_EQ(counts_, (Counts{{"/rosout", 10}, {"/topic", 10}}));
  EXPECT_TRUE(report_.warnings.empty());
}

// Expectations come from @mcap/core and @foxglove/rosmsg2-serialization on the same files.
TEST_F(McapSamples, EveryCompressionAndLayoutGivesTheSameOdometry) {
  for (const std::string name : {"plain", "chunk_none", "chunk_lz4", "chunk_zstd", "chunk_nosummary"}) {
    read("generated_by_our_notes/" + name + ".mcap");
    EXPECT_EQ(counts_, (Counts{{"/odom", 50}, {"/ticks", 50}})) << name;
    EXPECT_FALSE(report_.truncated || report_.damaged) << name;
    EXPECT_NEAR(x_sum_m_, 12.25, 1e-12) << name;
    EXPECT_EQ(last_.time_us, 1'700'000'000'816'666) << name;
    EXPECT_DOUBLE_EQ(last_.v_mps, 0.6) << name;
    EXPECT_NEAR(last_.theta_rad, 2 * std::atan2(-0.6377647021345036, 0.7702312540473074), 1e-15) << name;
  }
}

}  // namespace
}  // namespace astro::bag
