#include <gtest/gtest.h>

#include <cstdio>

#include "host/experiment/analysis/calibration.hpp"
#include "host/experiment/analysis/dead_reckoning.hpp"
#include "host/import/drives/import_drives.hpp"
#include "host/recording/rosbag_export.hpp"
#include "tests/host/import/drives/drive_files.hpp"
#include "tests/support/base/places.hpp"
#include "tests/support/base/temporary_folder.hpp"

// The raw files of a real robot under OptiTrack (Sousa et al., MIT licence), as its owners wrote them.
namespace astro::importing {
namespace {

namespace fs = std::filesystem;
using calibration::WheelFactors;

const fs::path kSquares = support::shared_data() / "sousa_optiodom/square";

class RealDrives : public testing::Test {
 protected:
  void SetUp() override {
    if (!fs::exists(kSquares)) GTEST_SKIP() << "not at hand: " << kSquares.string();
  }

  /// Ticks since the row before, left then right, without names; Motive's tables packed with gzip.
  static ImportedDrives session(const std::string& name) {
    ImportChoices choices;
    choices.geometry.wheel_diameter_m = 0.084;
    choices.geometry.counts_per_turn = 43.7 * 64;
    choices.geometry.wheelbase_m = 0.2;
    choices.wheels.table = {"time_s,left_counts,right_counts", true};
    std::vector<DriveFiles> files;
    for (int run = 1; run <= 6; ++run) {
      const std::string stem = fmt::format("{}/{}_run-{:02}", name, name, run);
      files.push_back({kSquares / (stem + "_odo.csv"), kSquares / (stem + "_opti.csv.gz")});
    }
    return import_drives(files, choices);
  }

  static experiment::Calibration calibrated(const experiment::RunSet& set) {
    return experiment::calibrate(set, {experiment::MethodChoice::Family::ml, {}});
  }

  static const ImportedDrives& training() {
    static const ImportedDrives drives = session("231220200029");
    return drives;
  }

  static void expect_like(const WheelFactors& found, const WheelFactors& expected) {
    constexpr double kSame = 1e-6;
    EXPECT_NEAR(found.c_r, expected.c_r, kSame);
    EXPECT_NEAR(found.c_l, expected.c_l, kSame);
    EXPECT_NEAR(found.b_m / expected.b_m, 1, kSame);
  }
};

double mean_path_m(const calibration::PathErrors& errors) {
  double sum = 0;
  for (const calibration::RunErrors& run : errors.runs) sum += run.path_rms_m;
  return sum / static_cast<double>(errors.runs.size());
}

TEST_F(RealDrives, RawFilesOfOneSessionCalibrateTheDrivesOfAnother) {
  const experiment::Calibration found = calibrated(training().set);
  const ImportedDrives unseen = session("231220200040");
  const std::vector<experiment::NamedFactors> factors{{"nominal", {1, 1, 0.2}}, {"found", found.factors}};
  const std::vector<experiment::DeadReckoning> judged = experiment::dead_reckon(unseen.set, factors);
  for (const experiment::DeadReckoning& one : judged)
    std::printf("  %s: end %.1f mm, heading %.1f mrad, mean path %.1f mm\n", one.by.name.c_str(),
                1000 * one.errors.final_rms_m, 1000 * one.errors.final_heading_rms_rad,
                1000 * mean_path_m(one.errors));
  const calibration::PathErrors& errors = judged[1].errors;
  EXPECT_LE(errors.final_rms_m, 0.0235);
  EXPECT_LE(errors.final_heading_rms_rad, 0.016);
  EXPECT_LE(mean_path_m(errors), 0.0155);
  EXPECT_EQ(found.judgement.verdict, calibration::Verdict::better);
  EXPECT_EQ(found.judgement.better_on(), 6);
}

/// Travel of the wheels and poses in space as a trajectory, for the writers.
calibration::Trajectory trajectory_of(const fs::path& wheels, const WheelSelection& selection) {
  calibration::Trajectory run;
  const double metres = std::numbers::pi * 0.084 / (43.7 * 64);
  for (const WheelSample& at : read_wheels(wheels, selection).track.samples)
    run.wheels.push_back({1e-9 * static_cast<double>(at.time_ns), metres * at.left, metres * at.right});
  return run;
}

TEST_F(RealDrives, TheSameDrivesInBagsOfRos2GiveTheSameFactors) {
  const test::TemporaryFolder folder;
  std::vector<DriveFiles> bags;
  const WheelSelection raw{{"time_s,left_counts,right_counts", true}, {}, false};
  for (int run = 1; run <= 6; ++run) {
    const std::string stem = fmt::format("231220200029/231220200029_run-{:02}", run);
    const calibration::Trajectory wheels = trajectory_of(kSquares / (stem + "_odo.csv"), raw);
    const ImportedTruth truth = read_truth(kSquares / (stem + "_opti.csv.gz"));
    const fs::path path = folder.path() / fmt::format("bag-{}", run);
    bag::Db3Writer bag(path);
    const int joints = bag.add_topic("/joint_states", "sensor_msgs/msg/JointState", "");
    const int poses = bag.add_topic("/tracker/pose", "geometry_msgs/msg/PoseStamped", "");
    for (const auto& at : wheels.wheels) {
      const std::int64_t time_ns = std::llround(1e9 * at.time_s);
      bag.write(joints, time_ns,
                ros2::encode_joint_state({time_ns,
                                          {"left_wheel", "right_wheel"},
                                          {2 * at.left_m / 0.084, 2 * at.right_m / 0.084},
                                          {},
                                          {}}));
    }
    for (const truth::TrackedPose& at : truth.track.samples) {
      const truth::Pose3& p = at.pose;
      // A tracker's driver publishes nothing while the body is lost.
      if (at.valid)
        bag.write(poses, at.time_ns,
                  test::pose_stamped(at.time_ns, {p.x_m, p.y_m, p.z_m, p.qx, p.qy, p.qz, p.qw}));
    }
    bag.close();
    bags.push_back({path, path});
  }
  ImportChoices choices;
  choices.geometry.wheel_diameter_m = 0.084;
  choices.geometry.wheelbase_m = 0.2;
  expect_like(calibrated(import_drives(bags, choices).set).factors, calibrated(training().set).factors);
}

TEST_F(RealDrives, TheSameDrivesWrittenByOurOwnExporterGiveTheSameFactors) {
  const test::TemporaryFolder folder;
  std::vector<DriveFiles> bags;
  for (std::size_t i = 0; i < training().set.runs.size(); ++i) {
    const fs::path path = folder.path() / fmt::format("bag-{}", i);
    recording::export_rosbag(training().set.runs[i], path);
    bags.push_back({path, path});
  }
  ImportChoices choices;
  choices.geometry.wheel_diameter_m = 0.084;
  choices.geometry.wheelbase_m = 0.2;
  choices.truth.poses.topic = "/truth";
  expect_like(calibrated(import_drives(bags, choices).set).factors, calibrated(training().set).factors);
}

}  // namespace
}  // namespace astro::importing
