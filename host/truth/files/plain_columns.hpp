#pragma once

#include <string>
#include <vector>

#include "host/formats/tables/table.hpp"
#include "host/formats/tables/time_column.hpp"
#include "host/truth/files/pose_columns.hpp"

/// Which columns of a table of poses hold what, by their names (plain_csv.hpp).
namespace astro::truth {

/// Further bodies are not looked at.
inline constexpr std::size_t kMostBodies = 200;

/// The columns of one body.
struct PlainHeader {
  std::string body;
  PoseColumns columns;
  tables::TimeColumns time;
  std::string length_unit, angle_unit;
};

/// The bodies that have a time and a position, each by what its columns' names begin with; a table of two rows, the ends of a
/// drive, needs no time. Throws astro::Error with file, line and
/// column for a unit that does not fit its column, or two units for one quantity.
std::vector<PlainHeader> plain_headers(const tables::Table& table, const std::vector<std::string>& names);

/// The column with the number of the tag that a row is about; -1 if there is none.
int tag_column(const std::vector<std::string>& names);

}  // namespace astro::truth
