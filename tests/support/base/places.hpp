#pragma once

#include <filesystem>

namespace astro::support {

/// The checkout that the tests were built from.
std::filesystem::path checkout();

/// Recordings beside a developer's checkout; elsewhere there are none, and tests that use them are skipped.
std::filesystem::path shared_data();

}  // namespace astro::support
