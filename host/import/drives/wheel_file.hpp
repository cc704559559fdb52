#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "host/import/bags/bag_wheels.hpp"
#include "host/import/bags/imu_rates.hpp"
#include "host/import/wheels/wheel_csv.hpp"
#include "host/import/wheels/wheel_track.hpp"
#include "host/recording/run.hpp"

namespace astro::importing {

/// What a person states about files of wheels; all else is recognised.
struct WheelSelection {
  WheelTable table;            // of tables
  BagWheelSelection bag;       // of bags
  bool exchanged = false;      // the file has left and right exchanged
  bool reversed = false;       // both encoders count backward when the robot drives forward
  std::string imu_topic = {};  // of bags; "": the only one
  /// The direction in the IMU's frame that points up, of length one; nothing: found from the data.
  std::optional<std::array<double, 3>> imu_axis = {};
};

struct ImportedWheels {
  WheelTrack track;
  /// Set if the file is a recording of this project, which contains the robot's parameters.
  std::optional<recording::RunInfo> info;
  ImuRates imu = {};  // of a bag
  /// Of a recording of this project.
  std::vector<recording::GyroPose> gyro = {};
  std::vector<recording::GyroSlip> slips = {};
};

/// Whether the file is a recording of this project. These are single MCAP files; one that was exported as a
/// bag or compressed counts as any other bag.
bool is_own_recording(const std::filesystem::path& path);

/// The wheels in a table, also packed with gzip or in UTF-16. Throws as wheels_in_table and tables::text_of_file do.
WheelTrack read_wheel_table(const std::filesystem::path& path, const WheelTable& table);

/// Undoes what a person states about the wheels: exchanged sides, encoders that count backward.
void orient(WheelTrack& track, const WheelSelection& selection);

/// The wheels in a table, in a bag, or in a recording of this project; the content shows which it is. Throws
/// as read_wheel_table, wheels_in_bag and read_run do.
ImportedWheels read_wheels(const std::filesystem::path& path, const WheelSelection& selection = {});

}  // namespace astro::importing
