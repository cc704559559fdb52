#pragma once

#include <string>
#include <string_view>

namespace astro {

/// Text that anybody may have written, made safe to print: valid UTF-8 without anything that moves a
/// terminal's cursor, changes its colours or title, or turns the direction of writing. Control characters (C0
/// but for line feed and tab, DEL, C1), bidirectional controls, line separators and bytes that are no UTF-8
/// become U+FFFD each. Text that is plain already comes back as it is; so does the result.
std::string plain_text(std::string_view text);

}  // namespace astro
