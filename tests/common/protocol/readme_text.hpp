#pragma once

#include <string>
#include <string_view>

namespace astro::protocol {

/// The generated part of common/protocol/README.md: enumerations, messages and an example, written from the
/// schema.
std::string generated_part();

/// `readme` with everything between its two marker lines replaced by generated_part(); empty if a marker is
/// missing.
std::string with_generated_part(std::string_view readme);

}  // namespace astro::protocol
