#pragma once

#include <filesystem>

#include "host/simulation/room/room.hpp"

namespace astro::simulation {

/// What is wrong with a file that describes a room. Values: the file; then the line and the name in question, except for
/// no_walls.
enum class RoomProblem { no_walls, unknown_name, wrong_value, too_many };

/// A room with the place of the scanner that looks at it, as a person writes them down:
///
///   # lengths in m; the robot starts at (0, 0) and looks along x
///   [[wall]]
///   corners = [[-1, -2], [5, -2], [5, 3], [-1, 3], [-1, -2]]
///   [[person]]
///   path = [[2, -1], [2, 2]]   # to and fro
///   speed = 0.8                # m/s
///   radius = 0.2
///   [scanner]                  # on the robot; all of it may be left out
///   x = 0.05
///   y = 0
///   yaw = 180                  # degrees
///   upside_down = false
///
/// A wall is a chain of straight pieces; what has a default may be left out.
struct RoomFile {
  Room room;
  Pose2 scanner_mount{};
  bool scanner_upside_down = false;
};

/// Throws astro::Error naming the file, the line and what is possible there; for what is no TOML as experiment::parse_toml().
RoomFile read_room(const std::filesystem::path& path);

}  // namespace astro::simulation
