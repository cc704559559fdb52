#pragma once

#include <string>
#include <variant>
#include <vector>

#include "host/base/bytes.hpp"
#include "host/film/picture/tag_sheet.hpp"
#include "host/film/picture/text_sheet.hpp"

namespace astro::film::paper {

using Sheet = std::variant<TagSheet, TextSheet>;

/// The first bytes of every PDF.
inline constexpr const char* kPdfMark = "%PDF-";

/// A PDF with one page for each sheet. Throws astro::Error where draw() does, and if the pages cannot be made.
Bytes pdf_of(const std::vector<Sheet>& sheets, const Paper& paper, const std::string& title);

}  // namespace astro::film::paper
