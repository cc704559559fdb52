#pragma once

#include <CLI/CLI.hpp>

namespace astro::cli {

/// `calibrate export`: a calibration for programs of others.
void add_calibrate_export(CLI::App& calibrate);

}  // namespace astro::cli
