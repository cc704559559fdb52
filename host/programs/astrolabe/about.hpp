#pragma once

#include <string>

#include "host/console/command_line.hpp"

namespace astro::commands {

/// 'completion', which prints what a shell needs to complete command lines, and for those who make packages 'manual', which
/// writes man pages. Both tell what the whole `app` has when they run.
void add_about(console::Command app, const std::string& version);

}  // namespace astro::commands
