#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "host/import/wheels/joint_wheels.hpp"
#include "host/import/wheels/wheel_csv.hpp"
#include "host/import/wheels/wheel_track.hpp"
#include "host/recording/run.hpp"

namespace astro::importing {

/// What a person says about files of wheels; what is not said is recognised.
struct WheelSelection {
  WheelTable table;        // of tables
  JointSelection joints;   // of bags
  bool exchanged = false;  // left is right
};

struct ImportedWheels {
  WheelTrack track;
  /// The file is a recording of this project, which knows its robot.
  std::optional<recording::RunInfo> info;
};

/// Our recordings are single MCAP files; exported as bags or packed they are bags as any other.
bool is_own_recording(const std::filesystem::path& path);

/// The wheels in a table, also packed with gzip. Throws as wheels_in_table and text_of_file do.
WheelTrack read_wheel_table(const std::filesystem::path& path, const WheelTable& table);

/// The wheels in a table, in a bag, or in a recording of this project, by the content of the file. Throws as
/// read_wheel_table, wheels_in_bag and read_run do.
ImportedWheels read_wheels(const std::filesystem::path& path, const WheelSelection& selection = {});

}  // namespace astro::importing
