#pragma once

namespace astro::truth {

/// What is wrong with a recording. Values: the file; then, except for those up to columns_differ, the line, the column if it is
/// known, and the text there. For units_differ the unit of the columns before comes first; for no_columns the names of all
/// columns follow the file, for times_too_coarse the percentage of the poses that repeat a time, and for columns_differ the line and the numbers of cells that the row has and that it should have.
enum class TrackProblem {
  unknown_form,
  older_motive,
  no_motive_header,
  no_header,
  no_body,
  no_pose,
  no_columns,
  columns_differ,
  no_rigid_body,
  length_unit_unknown,
  angle_unit_unknown,
  unit_of_other_quantity,
  units_differ,
  not_a_number,
  no_frame_number,
  no_time,
  time_unit_unknown,
  time_not_increasing,
  times_too_coarse
};

}  // namespace astro::truth
