#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "host/formats/tables/table.hpp"

namespace astro::tables {

/// Why a statement about columns does not fit a table. Values: the file, the name that is not there (then those that are) or
/// that is said to be nothing, or how many columns there are.
enum class StatedColumnsProblem { no_such_name, no_meaning, too_many };

/// The names that a person gives the columns of a table, one for each of them. `stated` is either such a list
/// ("time_s,left_counts,-,right_counts"; "-", or any name that says nothing, for a column that is not used), or says what some
/// of the names mean ("stamp=time_ms,encA=left_counts", in any case if that leaves one column); the other columns then keep theirs out of use. "" changes nothing.
/// Throws astro::Error naming the file if a name is not there, or if there are more names than columns.
std::vector<std::string> names_with(std::string_view stated, const Table& table);

}  // namespace astro::tables
