#pragma once

#include <string_view>

namespace astro {

/// Whether JSON text may be parsed: its values take at most about 40 MiB plus twice the size of the text, and
/// it nests at most 100 levels deep. Short values take many times the memory of their text ("[],[],[]"), so a
/// file of nothing else must not be parsed. Counts only commas, colons, brackets and strings; for text that
/// is no JSON the answer means nothing.
bool json_fits_memory(std::string_view text);

}  // namespace astro
