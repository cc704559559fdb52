#pragma once

#include <filesystem>

#include "host/import/drives/robot_geometry.hpp"
#include "host/import/drives/wheel_file.hpp"

namespace astro::importing {

/// The geometry for each drive, completed with wheel diameter and wheelbase from the robot's description (URDF) that was
/// recorded in the drive's bag beside the wheels, or in that of an earlier one: the topic robot_description, in any namespace,
/// whose description has the joints of the wheels.
class RecordedSizes {
 public:
  /// `given` must outlive it.
  explicit RecordedSizes(const RobotGeometry& given) : given_(given), last_(given) {}

  /// A remark of the wheels states the sizes. Does not search if nothing is missing, or if the wheels are not from a bag. Throws
  /// astro::Error naming the bag if a description has the wheels but not their sizes, and what bag::read_bag throws.
  const RobotGeometry& of(const std::filesystem::path& file, ImportedWheels& wheels);

 private:
  const RobotGeometry& given_;
  RobotGeometry last_;
};

}  // namespace astro::importing
