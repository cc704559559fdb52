#pragma once

#include <filesystem>

#include "host/recording/run.hpp"

namespace astro::recording {

/// Writes `odometry.csv` and `truth.csv` into `folder` (made if needed) for PlotJuggler and spreadsheets:
/// comma, point, one row per sample. The first column is `__time`, seconds on the robot's clock; the others
/// carry their unit in the name and a tree in slashes. Numbers are shortest decimals that read back exactly;
/// the pose of an invalid truth sample is left empty. Each file appears whole. Throws astro::Error naming the
/// file.
void export_csv(const Run& run, const std::filesystem::path& folder);

}  // namespace astro::recording
