#pragma once

#include <string>
#include <vector>

#include "host/commands/shared/robot_view.hpp"
#include "host/experiment/drive/change_guard.hpp"
#include "host/robot/parameters/parameters.hpp"

/// A robot's parameters for people and for programs.
namespace astro::commands {

/// All rows; a star marks those that differ from the default. Lines longer than `columns` are cut; 0: none.
std::string parameter_table(const robot::RemoteParameters& robot, std::size_t columns);

/// One parameter with everything in its table row.
Json to_json(const robot::ParameterRow& row);

Json to_json(const robot::Value& value);

/// The value in force in the fewest digits that read back as the same value, or the text itself, as `params
/// set` takes it.
std::string plain(const robot::ParameterRow& row);

/// "m, 0.05 to 2, default 0.29: Wheelbase".
std::string explanation(const robot::ParameterRow& row);

/// The value that a person typed for this row. Throws astro::Error if the row needs a number and it is none.
robot::Value parse_value(const robot::ParameterRow& row, const std::string& text);

/// What a commit would change.
std::vector<robot::Change> staged_changes(const robot::RemoteParameters& robot);

}  // namespace astro::commands
