#pragma once

#include <string>
#include <vector>

/// Opens a page in headless Chromium and reads back what its scripts have made of it.
namespace astro::report {

bool browser_is_installed();

/// The document after all scripts have run, as HTML. The page is given `virtual_ms` of the browser's own
/// clock.
std::string open_in_browser(const std::string& html, int virtual_ms = 60'000);

/// The pages of the document as it is printed on paper after all scripts have run.
int pages_on_paper(const std::string& html);

/// One <figure> of an opened page.
struct DrawnFigure {
  std::string kind, group, phase;  // its data attributes, "" where it has none
  bool drawn = false, failed = false;
  int traces = 0;   // <g class="trace scatter"> elements of its SVG
  int strokes = 0;  // ... lines, marks and error bars that have a shape
};
std::vector<DrawnFigure> figures_of(const std::string& dom);

}  // namespace astro::report
