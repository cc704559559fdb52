#pragma once

#include <span>
#include <string>
#include <string_view>

/// The pages of this folder, as they were when the program was built.
namespace astro::guides {

struct Guide {
  std::string_view name, text;  // text: Markdown in lines of 80 columns, of which the first is "# TITLE"

  std::string_view title() const { return text.substr(2, text.find('\n') - 2); }
};

/// In the order in which a list shows them.
std::span<const Guide> all();

}  // namespace astro::guides
