#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "host/commands/experiment/wall_umbmark.hpp"
#include "host/commands/shared/connection.hpp"
#include "host/commands/shared/film_truth.hpp"
#include "host/commands/shared/method_option.hpp"
#include "host/commands/shared/truth_option.hpp"
#include "host/console/command_line.hpp"
#include "host/experiment/files/plan.hpp"

/// The options of `umbmark`, and which of them go with which ground truth.
namespace astro::commands {

struct UmbmarkOptions {
  ConnectionOptions connection;
  TruthOption truth;
  experiment::Plan plan;
  std::filesystem::path out;
  std::string order = "alternating", unit, angle_unit = "deg";
  MethodOption method;
  experiment::Until until;
  console::Option until_option, truth_folder, unit_option, angle_unit_option;
  console::Option line, speed, yaw_rate;  // a wall has other defaults
  WallOptions wall;
  std::vector<std::pair<std::string, console::Option>> not_of_wall;
  std::optional<std::filesystem::path> film;  // --truth film:FILE
  FilmOptions film_figures;
  bool yes = false, force = false, json = false, no_extras = false, pause = false;
};

void add_umbmark_options(console::Command command, UmbmarkOptions& options);

/// Throws console::WrongUsage if an option is given that has no effect with the chosen ground truth.
void refuse_options_of_other_truth(const UmbmarkOptions& options);

}  // namespace astro::commands
