#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "host/base/error.hpp"
#include "host/import/drives/stated_drives.hpp"

/// Statements that would have no effect are refused, because whoever makes one expects that it counts.
namespace astro::importing {

enum class Choice {
  wheel_columns,
  per_interval,
  counter_range,
  truth_columns,
  wheels_topic,
  wheels_unit,
  imu_topic,
  imu_axis,
  joints,
  truth_topic,
  truth_frames,
  body,
  controller,
  up,
  truth_unit,
  truth_mirrored,
  robot,
  wheel_diameter,
  counts_per_turn,
  wheelbase,
  swap_wheels,
  reverse_wheels,
  drives_backward
};

/// "wheel_columns", as the enumerator.
std::string_view name_of(Choice choice);

/// A statement that applies to none of the files.
class UnusedChoice : public Error {
 public:
  UnusedChoice(Choice choice, const std::string& why)
      : Error(std::string(name_of(choice)) + " does not apply here: " + why), choice_(choice), why_(why) {}

  Choice choice() const { return choice_; }
  const std::string& why() const { return why_; }

 private:
  Choice choice_;
  std::string why_;
};

/// What is stated beside the files.
std::vector<Choice> stated_choices(const StatedDrives& drives);

/// Throws UnusedChoice if one applies to none of the named files: one about tables of wheels without tables, one about bags
/// without bags. A missing file counts as any kind, because its reader gives a better error.
void refuse_unused_choices(const StatedDrives& drives);

/// The same if each drive's truth is a file with scans: what is about trackers applies to none, and to a log of CARMEN little more
/// than the wheelbase.
void refuse_choices_unused_with_scans(const StatedDrives& drives);

/// The same if the drives are arrays of a program, which have one unit, no columns and no topics to choose.
void refuse_choices_unused_with_arrays(const StatedDrives& drives);

}  // namespace astro::importing
