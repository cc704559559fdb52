#include "host/formats/cdr/cdr.hpp"

#include <gmock/gmock.h>

#include "host/formats/messages/ros_messages.hpp"
#include "host/recording/sample_messages.hpp"

namespace astro::recording {
namespace {

using ::testing::ElementsAre;

void put_header(ros2::CdrWriter& out, std::string_view frame) {
  out.number(std::int32_t{1});
  out.number(std::uint32_t{2});
  out.string(frame);
}

void put_doubles(ros2::CdrWriter& out, int count) {
  for (int i = 0; i < count; ++i) out.number(1.5);
}

std::size_t pose_stamped_size(std::string_view frame) {
  ros2::CdrWriter out;
  put_header(out, frame);
  put_doubles(out, 7);
  return out.bytes().size();
}

// Sizes of messages that three independent ROS 2 writers produced.
TEST(Cdr, MessagesHaveTheSizesThatOtherWritersGiveThem) {
  EXPECT_EQ(pose_stamped_size(""), 76U);
  EXPECT_EQ(pose_stamped_size("world"), 84U);
  ros2::CdrWriter twist;
  put_doubles(twist, 6);
  EXPECT_EQ(twist.bytes().size(), 52U);
  ros2::CdrWriter with_covariance;
  put_header(with_covariance, "map");
  put_doubles(with_covariance, 7 + 36);
  EXPECT_EQ(with_covariance.bytes().size(), 364U);
  ros2::CdrWriter transforms;  // tf2_msgs/TFMessage with one transform
  transforms.number(std::uint32_t{1});
  put_header(transforms, "odom");
  transforms.string("base_footprint");
  put_doubles(transforms, 7);
  EXPECT_EQ(transforms.bytes().size(), 108U);
  EXPECT_EQ(recording::encode_odometry({}).size(), 724U);
}

TEST(Cdr, NumbersStartAtMultiplesOfTheirSizeCountedFromBehindTheHeader) {
  ros2::CdrWriter out;
  out.number(std::uint8_t{0xAA});
  out.number(std::uint16_t{0x1122});
  out.number(std::uint8_t{0xBB});
  out.number(std::uint32_t{0x33445566});
  EXPECT_THAT(out.bytes(),
              ElementsAre(0, 1, 0, 0, 0xAA, 0, 0x22, 0x11, 0xBB, 0, 0, 0, 0x66, 0x55, 0x44, 0x33));
}

TEST(Cdr, StringsCarryTheirLengthWithTheNul) {
  ros2::CdrWriter out;
  out.string("ab");
  EXPECT_THAT(out.bytes(), ElementsAre(0, 1, 0, 0, 3, 0, 0, 0, 'a', 'b', 0));
}

TEST(Cdr, ReaderGivesBackWhatTheWriterTook) {
  ros2::CdrWriter out;
  out.number(std::uint8_t{7});
  out.string("odom");
  out.number(-1.25e300);
  out.string("");
  out.number(std::int32_t{-5});
  const Bytes bytes = out.bytes();
  ros2::CdrReader in(bytes);
  EXPECT_EQ(in.number<std::uint8_t>(), 7);
  EXPECT_EQ(in.string(), "odom");
  EXPECT_EQ(in.number<double>(), -1.25e300);
  EXPECT_EQ(in.string(), "");
  EXPECT_EQ(in.number<std::int32_t>(), -5);
  EXPECT_TRUE(in.ok());
}

TEST(Cdr, ReaderTakesAnEmptyStringOfLengthZero) {
  const Bytes message{0, 1, 0, 0, 0, 0, 0, 0, 9, 0, 0, 0};
  ros2::CdrReader in(message);
  EXPECT_EQ(in.string(), "");
  EXPECT_EQ(in.number<std::uint32_t>(), 9U);
  EXPECT_TRUE(in.ok());
}

TEST(Cdr, ReaderRefusesOtherEncapsulations) {
  for (const Bytes& header : {Bytes{1, 0, 0, 0}, Bytes{0, 2, 0, 0}, Bytes{0, 3, 0, 0}, Bytes{0, 7, 0, 0},
                              Bytes{0, 1, 0}, Bytes{}}) {
    Bytes message = header;
    if (message.size() == 4) message.resize(8, 1);
    ros2::CdrReader in(message);
    EXPECT_EQ(in.number<std::uint32_t>(), 0U);
    EXPECT_FALSE(in.ok());
  }
}

TEST(Cdr, ReaderRefusesStringsThatReachPastTheEndOrLackTheNul) {
  const Bytes huge{0, 1, 0, 0, 0xFF, 0xFF, 0xFF, 0xFF, 'a', 0};
  ros2::CdrReader past(huge);
  EXPECT_EQ(past.string(), "");
  EXPECT_FALSE(past.ok());
  const Bytes bare{0, 1, 0, 0, 2, 0, 0, 0, 'a', 'b'};
  ros2::CdrReader without_nul(bare);
  without_nul.string();
  EXPECT_FALSE(without_nul.ok());
}

TEST(RosMessages, CutAnywhereTheyAreRefused) {
  const Bytes odometry = recording::encode_odometry({1, 2, 3, 0.5, 5, 6, 7, 8});
  const Bytes truth = recording::encode_truth({1, 2, 3, 0.5, true});
  const Bytes counts = recording::encode_counts({1, 2, 3});
  ASSERT_TRUE(recording::decode_truth(truth));
  ASSERT_TRUE(recording::decode_counts(counts));
  ASSERT_TRUE(recording::decode_odometry(odometry));
  for (std::size_t size = 0; size < odometry.size(); ++size) {
    EXPECT_FALSE(recording::decode_odometry(ByteView(odometry).first(size))) << size;
  }
  for (std::size_t size = 0; size < truth.size(); ++size) {
    EXPECT_FALSE(recording::decode_truth(ByteView(truth).first(size))) << size;
  }
  for (std::size_t size = 0; size < counts.size(); ++size) {
    EXPECT_FALSE(recording::decode_counts(ByteView(counts).first(size))) << size;
  }
}

TEST(RosMessages, StampsHoldTimesBeforeZeroAndRefuseThoseBeyondThirtyTwoBitsOfSeconds) {
  for (const std::int64_t time_us : {std::int64_t{-1}, std::int64_t{-1'000'000}, std::int64_t{0},
                                     std::int64_t{1'999'999}, std::int64_t{2'147'483'647'999'999}}) {
    ASSERT_TRUE(ros2::fits_stamp(time_us));
    EXPECT_EQ(recording::decode_counts(recording::encode_counts({time_us, 0, 0}))->time_us, time_us);
  }
  EXPECT_FALSE(ros2::fits_stamp(std::int64_t{2'147'483'648'000'000}));
  EXPECT_FALSE(ros2::fits_stamp(std::int64_t{-2'147'483'648'000'001}));
}

TEST(RosMessages, AHeadingIsTheSameForBothSignsOfItsQuaternion) {
  Bytes message = recording::encode_truth({0, 0, 0, 1.0, true});
  const double theta_rad = recording::decode_truth(message)->theta_rad;
  for (std::size_t at = message.size() - 9; at < message.size(); at += 8)
    message[at] ^= 0x80;  // signs of z, w
  EXPECT_NEAR(theta_rad, 1.0, 1e-15);
  EXPECT_DOUBLE_EQ(recording::decode_truth(message)->theta_rad, theta_rad);
}

}  // namespace
}  // namespace astro::recording
