#include "host/import/bags/imu_rates.hpp"

#include <gmock/gmock.h>

#include "host/base/files.hpp"
#include "host/formats/cdr/codec.hpp"
#include "host/formats/files/db3_writer.hpp"
#include "host/formats/files/mcap_writer.hpp"
#include "host/formats/messages/ros_messages.hpp"
#include "host/formats/messages/sensors.hpp"
#include "host/import/drives/yaw_axis.hpp"
#include "host/import/wheels/unclear_choice.hpp"
#include "tests/support/base/remarks.hpp"
#include "tests/support/base/temporary_folder.hpp"
#include "tests/support/ros1/ros1_bag.hpp"

namespace astro::importing {
namespace {

namespace fs = std::filesystem;
using ros2::msg::Imu;
using support::Tells;
using support::told_by;
using testing::Contains;
using testing::ElementsAre;
using testing::IsEmpty;

constexpr std::int64_t kStart_ns = 1'790'000'000'000'000'000, kPeriod_ns = 10'000'000;
constexpr std::int64_t kTransport_ns = 3'000'000;

std::int64_t stamp_ns(int i) { return kStart_ns + i * kPeriod_ns; }

/// Turns about its x axis, faster and faster.
Imu message(int i, bool stamped = true) {
  Imu imu;
  imu.header = {ros2::msg::to_time(stamped ? stamp_ns(i) : 0), "imu_link"};
  imu.angular_velocity = {0.1 * i, 0.2, -0.3};
  return imu;
}

struct ImuBags : testing::Test {
  fs::path mcap(const std::vector<std::string>& topics, int messages, bool stamped = true,
                bool rates = true) const {
    const fs::path path = folder.path() / "x.mcap";
    PartFile file(path);
    bag::McapWriter writer([&](ByteView bytes) { file.write(bytes); }, {"ros2", "test"});
    const auto schema = writer.add_schema(Imu::kType, "ros2msg", ros2::ros_type<Imu>().definition);
    for (const std::string& topic : topics) {
      const auto channel = writer.add_channel(schema, topic, "cdr", {});
      for (int i = 0; i < messages; ++i) {
        Imu imu = message(i, stamped);
        if (!rates) imu.angular_velocity_covariance[0] = -1;
        writer.write(channel, static_cast<std::uint64_t>(stamp_ns(i) + kTransport_ns), ros2::encode(imu));
      }
    }
    writer.close();
    file.commit();
    return path;
  }
  static void expect_read(const ImuRates& found, std::int64_t late_ns = 0) {
    ASSERT_EQ(found.samples.size(), 50U);
    for (int i = 0; i < 50; ++i) {
      const ImuRate& sample = found.samples[static_cast<std::size_t>(i)];
      EXPECT_EQ(sample.time_ns, stamp_ns(i) + late_ns);
      EXPECT_THAT(sample.rate_radps, ElementsAre(0.1 * i, 0.2, -0.3));
    }
  }

  const test::TemporaryFolder folder;
};

TEST_F(ImuBags, GiveTheRatesOfTheirOnlyImuAtItsStamps) {
  const ImuRates found = imu_rates_in_bag(mcap({"/imu/data"}, 50));
  EXPECT_EQ(found.topic, "/imu/data");
  EXPECT_THAT(found.remarks, IsEmpty());
  expect_read(found);
}

TEST_F(ImuBags, InSqliteGiveTheSame) {
  bag::Db3Writer writer(folder.path() / "bag");
  const int topic = writer.add_topic("/imu", Imu::kType, ros2::ros_type<Imu>().definition);
  for (int i = 0; i < 50; ++i) writer.write(topic, stamp_ns(i) + kTransport_ns, ros2::encode(message(i)));
  writer.close();
  expect_read(imu_rates_in_bag(folder.path() / "bag"));
}

TEST_F(ImuBags, OfRos1GiveTheSame) {
  using namespace support;
  Ros1Bag bag("lz4");
  bag.topic(0, "/imu", "sensor_msgs/Imu",
            "Header header\ngeometry_msgs/Quaternion orientation\nfloat64[9] orientation_covariance\n"
            "geometry_msgs/Vector3 angular_velocity\nfloat64[9] angular_velocity_covariance\n"
            "geometry_msgs/Vector3 linear_acceleration\nfloat64[9] linear_acceleration_covariance\n" +
                ros1::kHeader + ros1::kQuaternion + ros1::kVector);
  for (int i = 0; i < 50; ++i) bag.message(0, stamp_ns(i) + kTransport_ns, Ros1Message::encode(message(i)));
  const fs::path path = folder.path() / "x.bag";
  PartFile file(path);
  file.write(bag.closed());
  file.commit();
  expect_read(imu_rates_in_bag(path));
}

TEST_F(ImuBags, WithoutStampsHaveTheRecordersTimes) {
  expect_read(imu_rates_in_bag(mcap({"/imu"}, 50, false)), kTransport_ns);
}

TEST_F(ImuBags, WithSeveralImusGiveNoneUnlessOneIsNamed) {
  const fs::path path = mcap({"/imu/data", "/imu/data_raw"}, 50);
  const ImuRates none = imu_rates_in_bag(path);
  EXPECT_THAT(none.samples, IsEmpty());
  EXPECT_THAT(none.remarks, Contains(Tells(ChoiceRemark::several_imus, "/imu/data", "/imu/data_raw")));
  expect_read(imu_rates_in_bag(path, "/imu/data_raw"));
  EXPECT_EQ(told_by([&] { imu_rates_in_bag(path, "/gyro"); }).kind, Kind(WheelProblem::imu_unclear));
}

TEST_F(ImuBags, WhoseImuMeasuresNoRatesGiveNone) {
  const ImuRates none = imu_rates_in_bag(mcap({"/imu"}, 50, true, false));
  EXPECT_THAT(none.samples, IsEmpty());
  EXPECT_THAT(none.remarks, testing::SizeIs(1));
}

/// Spins to and fro for 20 s; the sensor turns about its axis `which`, `late_s` later, with a bias.
struct Spinning {
  std::vector<recording::OdometrySample> odometry;
  ImuRates rates{"/imu", {}, {}};

  Spinning(std::size_t which, double sign, double late_s, double radps) {
    for (int i = 0; i < 2000; ++i) {
      const double time_s = 0.01 * i;
      recording::OdometrySample sample;
      sample.time_us = std::llround(1e6 * time_s);
      sample.omega_radps = radps * std::sin(time_s);
      odometry.push_back(sample);
      ImuRate rate{1000 * sample.time_us, {0.01, 0.05 * std::sin(50 * time_s), -0.02}};
      rate.rate_radps[which] += sign * radps * std::sin(time_s - late_s);
      rates.samples.push_back(rate);
    }
  }
};

TEST(YawAxis, IsFoundWithItsSignByTheWheelsThoughTheSensorLags) {
  for (std::size_t which = 0; which < 3; ++which)
    for (const double sign : {-1.0, 1.0}) {
      const Spinning drive(which, sign, 0.19, 0.8);
      std::vector<Remark> remarks;
      const auto yaw = yaw_rates_of(drive.rates, drive.odometry, std::nullopt, remarks);
      ASSERT_EQ(yaw.size(), drive.rates.samples.size());
      const std::string name = (sign < 0 ? "-" : "") + std::string(1, "xyz"[which]);
      EXPECT_THAT(remarks, Contains(Tells(ChoiceRemark::yaw_axis_recognised, name, "/imu")));
      for (std::size_t i = 0; i < yaw.size(); i += 100)
        EXPECT_NEAR(yaw[i].rate_radps, sign * drive.rates.samples[i].rate_radps[which], 1e-12);
    }
}

TEST(YawAxis, ThatIsStatedCounts) {
  const Spinning drive(2, 1, 0, 0.8);
  std::vector<Remark> remarks;
  const auto yaw = yaw_rates_of(drive.rates, drive.odometry, std::array<double, 3>{0, 0, -1}, remarks);
  ASSERT_FALSE(yaw.empty());
  EXPECT_DOUBLE_EQ(yaw[100].rate_radps, -drive.rates.samples[100].rate_radps[2]);
  EXPECT_THAT(remarks, IsEmpty());
}

TEST(YawAxis, IsNotGuessedWhereTheRobotHardlyTurns) {
  const Spinning drive(2, 1, 0, 0.005);
  std::vector<Remark> remarks;
  EXPECT_THAT(yaw_rates_of(Spinning(1, 0, 0, 0.8).rates, drive.odometry, std::nullopt, remarks), IsEmpty());
  EXPECT_THAT(remarks, Contains(Tells(ChoiceRemark::yaw_axis_unclear, "/imu")));
}

}  // namespace
}  // namespace astro::importing
