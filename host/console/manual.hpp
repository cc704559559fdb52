#pragma once

#include <string>
#include <vector>

#include "host/console/command_line.hpp"

namespace astro::console {

struct ManualPage {
  std::string name;  // of the file without the section's number: astrolabe-calibrate-files
  std::string text;  // as man(7) wants it
};

/// A page for the program and for each of its commands, in section 1, made of what --help says.
///
/// Params  version  as in 'astrolabe 0.1.0', at the foot of each page
std::vector<ManualPage> manual_of(Command program, const std::string& version);

}  // namespace astro::console
