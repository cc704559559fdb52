#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "host/page/calls/calls.hpp"

namespace astro::page {

/// What is in some files, and which of them make a drive.
///
/// question  {"files": [name, ...], "roles": {name: "wheels", "truth", "both" or "none"}, and what is stated (statements.hpp)}.
///             A file without a role is recognised by its content.
/// answer    {"files": [{"name", "wheels", "truth", "robot": what it is taken for,
///              "scans": its ground truth are the scans of a laser scanner,
///              "inspection": what `inspect --json` prints, whatever is stated, or null,
///              "understood": {"wheels", "truth"}: what `inspect --json` prints of wheels and of a body, of those that are taken
///                as stated; without those that it is not taken for,
///              "controllers": of a robot's file with several, their names,
///              "problem": {"sentence", "remedies"} or null,
///              "table": {"names", "columns": how many, "rows": the first of them as text} of a table, otherwise null,
///              "preview": {"wheels": {"t_s", "left", "right", "unit"}, "truth": {"t_s", "x_m", "y_m", "z_m"}}, at most 600
///                points of each, of a truth null where it was lost; without those that it is not taken for}],
///            "drives": [{"wheels", "truth"}, ...], as they are paired by their names; one of them "" where a file is missing,
///            "roles": {"wheels": [...], "truth": [...]}: what a column can be called,
///            "units": {"wheels": [...], "truth": [...]}: what "wheels_unit" and "truth_unit" can be}
///
/// Throws astro::Error for names that lead out of the folder, wrong types and statements that mean nothing; what is wrong with a
/// file is its problem.
nlohmann::json inspect(const nlohmann::json& question, const std::filesystem::path& folder, const Emit& emit);

}  // namespace astro::page
