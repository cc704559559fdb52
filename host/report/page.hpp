#pragma once

#include <cstddef>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

/// One HTML page made of sections, which needs nothing but a browser.
namespace astro::report {

/// A part of the page. Text and tables are complete HTML; figures are empty frames
/// (<figure data-figure=...>) that web/report.js fills.
struct Section {
  std::string id, heading, body;
};

/// Phases beyond the fourth take the colours of the first again, as in web/report.js.
inline constexpr std::size_t kAccents = 4;

/// The whole page, in the order of the sections; one whose body is "" is left out. `data` is what
/// web/report.js draws from.
std::string render_page(const std::string& title, const std::vector<Section>& sections,
                        const nlohmann::json& data);

/// Throws astro::Error if there is a file at `path` that is no page of this kind. write_page() checks it, too; call it before
/// work that would be lost.
void require_replaceable(const std::filesystem::path& path);

/// `path` never holds half a page. Throws what require_replaceable and PartFile throw.
void write_page(const std::filesystem::path& path, const std::string& html);

}  // namespace astro::report
