#pragma once

#include <string>
#include <vector>

#include "host/base/error.hpp"

namespace astro::page {

/// Which statements help against an error of drives: the names of importing::Choice, the likeliest first. Empty if none does, as of
/// a damaged file.
std::vector<std::string> remedies(const Error& error);

}  // namespace astro::page
