#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "host/commands/shared/connection.hpp"
#include "host/console/command_line.hpp"
#include "host/truth/source/reading.hpp"
#include "host/wall/wall_journal.hpp"

/// `umbmark --truth wall`: the calibration with a wall and a ruler, which drives laps in place of squares.
namespace astro::commands {

struct WallOptions {
  wall::WallPlan plan;
  double alignment_deg = 0;  // plan.squaring_rad, if it is given
  console::Option alignment;
  std::vector<std::pair<std::string, console::Option>> own;  // which no other truth has
};

/// Adds the options that only a wall has.
void add_wall_options(console::Command command, WallOptions& options);

/// What umbmark has for every truth.
struct WallSettings {
  std::filesystem::path out;
  std::optional<truth::LengthUnit> unit;  // asked for if a ruler is read
  bool yes = false, force = false, json = false;
};

/// Drives, estimates, writes `out`/calib.toml, and loads it if the person agrees. Throws as run_wall_experiment and
/// load_parameters do.
void run_wall(ConnectionOptions& connection, const wall::WallPlan& plan, const WallSettings& settings);

}  // namespace astro::commands
