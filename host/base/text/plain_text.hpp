#pragma once

#include <string>
#include <string_view>

namespace astro {

/// Makes untrusted text safe to print: the result is valid UTF-8 without anything that moves a terminal's
/// cursor, changes its colours or title, or changes the writing direction. Control characters (C0 except line
/// feed and tab, DEL, C1), bidirectional controls, line separators and bytes that are no UTF-8 become U+FFFD
/// each. Text that is plain already is returned unchanged.
std::string plain_text(std::string_view text);

}  // namespace astro
