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

/// One parameter with all that its table says.
Json to_json(const robot::ParameterRow& row);

Json to_json(const robot::Value& value);

/// The value in force in the fewest digits that give it again, or the text itself: what `params set` takes.
std::string plain(const robot::ParameterRow& row);

/// "m, 0.05 to 2, default 0.29: Wheelbase".
std::string explanation(const robot::ParameterRow& row);

/// What a person typed as a value of this row. Throws astro::Error if it is no number where one is needed.
robot::Value parse_value(const robot::ParameterRow& row, const std::string& text);

/// What a commit would change.
std::vector<experiment::Change> staged_changes(const robot::RemoteParameters& robot);

}  // namespace astro::commands
