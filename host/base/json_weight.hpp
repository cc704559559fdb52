#pragma once

#include <string_view>

namespace astro {

/// Whether JSON text may be parsed: as values it takes at most about 40 MiB, and beyond that twice the size
/// of the text, and it nests no more than 100 levels deep. Short values take many times their text
/// ("[],[],[]"), so text of nothing else must not be parsed as a whole. Looks at commas, colons and brackets
/// alone: text that is no JSON gets some answer.
bool json_fits_memory(std::string_view text);

}  // namespace astro
