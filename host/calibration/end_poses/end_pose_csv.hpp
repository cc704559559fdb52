#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "host/base/text/sense.hpp"
#include "host/calibration/end_poses/end_pose.hpp"

/// End poses from comma separated text that a spreadsheet or a person wrote.
///
/// The first line names the columns, each with its unit, in any order and case:
///
///   ex_mm   | ex_cm ... | x_err_m ...              error in x, required
///   ey_mm   | ey_cm ... | y_err_m ...              error in y, required
///   etheta_rad | etheta_deg | heading_err_deg ...  error of the heading; no column or an empty cell: not
///                                                  measured
///   direction                                      cw or ccw, the same in all rows
///
/// Other columns (run, euclid_mm, ...) are ignored. A byte order mark, CRLF or CR line ends, blank lines,
/// spaces round a cell and quoted cells are accepted. Numbers have a decimal point, whatever the locale.
///
/// Every message begins with `name`, the name of the file. Throws astro::Error with the line and the column for
///   a column that is missing, doubled, or without a known unit; no header; no data rows
///   a row with too few or too many cells; an open quote; semicolons; text that is not UTF-8
///   a cell that is empty, not a number, not finite, or not a direction
namespace astro::calibration {

/// Why a table gives no end poses, in addition to CsvProblem. Values: its name; the line, except for no_rows;
/// then the quantity, "ex" (no_column), the column's title (no_unit), both titles (two_columns), the cell
/// (no_direction, other_direction), or the column's title and the cell's text (empty_cell, not_a_number, not_finite).
enum class EndPoseTableProblem {
  no_rows,
  no_column,
  two_columns,
  no_unit,
  empty_cell,
  not_a_number,
  not_finite,
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
