#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "host/base/text/sense.hpp"
#include "host/calibration/end_poses/end_pose.hpp"

/// End poses from a table that a spreadsheet or a person wrote (host/formats/tables/table.hpp: separators, decimal commas,
/// comments).
///
/// The header names the columns, each with its unit, in any order and case:
///
///   ex_mm   | ex_cm ... | x_err_m | "x error [mm]"     error in x, required
///   ey_mm   | ey_cm ... | y_err_m ...                  error in y, required
///   etheta_rad | etheta_deg | heading_err_deg ...      error of the heading; no column or an empty cell: not measured
///   direction                                          cw or ccw, the same in all rows
///
/// Other columns (run, euclid_mm, ...) are ignored, but where no column gives the heading, none may be about an angle.
///
/// Every message begins with `name`, the name of the file. Throws astro::Error with the line and the column for
///   a column that is missing, doubled, or whose name is not understood; no header; no data rows, or more than 100 000
///   a row with more cells than names (tables::TableProblem)
///   a cell that is empty, no finite number, or not a direction
/// and what tables::Table throws.
namespace astro::calibration {

/// Why a table gives no end poses. Values: its name; the line, except for no_rows;
/// then the quantity, "ex" (no_column), the column's title (no_unit), both titles (two_columns), the cell
/// (no_direction, other_direction), or the column's title and the cell's text (empty_cell, not_a_number).
enum class EndPoseTableProblem {
  no_rows,
  too_many_rows,
  no_column,
  two_columns,
  no_unit,
  empty_cell,
  not_a_number,
  no_direction,
  both_directions,
  other_direction
};

struct EndPoseTable {
  std::vector<EndPose> poses;  // in file order
  std::vector<int> lines;      // of each, from 1
};

/// Refuses a file whose `direction` column mixes both directions, or has another one than `sense`.
EndPoseTable read_end_poses(std::string_view text, std::string_view name, std::optional<Sense> sense = {});

}  // namespace astro::calibration
