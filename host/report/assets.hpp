#pragma once

#include <string_view>

/// The files that a report is made of, as they were when the program was built (host/report/embed_web.cmake).
namespace astro::report::assets {

std::string_view library_js();  // the plotting library, from npm
std::string_view script_js();   // web/report.js
std::string_view style_css();   // web/report.css
std::string_view template_html();

}  // namespace astro::report::assets
