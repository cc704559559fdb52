#include "host/report/page.hpp"

#include <nlohmann/json.hpp>

#include "host/base/files.hpp"
#include "host/report/assets.hpp"
#include "host/report/html.hpp"

namespace astro::report {

std::string render_page(const std::string& title, const std::vector<Section>& sections,
                        const nlohmann::json& data) {
  std::string links, body;
  for (const Section& s : sections) {
    if (s.body.empty()) continue;
    links += "<a href=\"#" + s.id + "\">" + s.heading + "</a>\n";
    body += "<section id=\"" + s.id + "\"><h2>" + s.heading + "</h2>\n" + s.body + "</section>\n";
  }
  return fill(assets::template_html(), {{"title", escape(title)},
                                        {"style", std::string(assets::style_css())},
                                        {"links", links},
                                        {"body", body},
                                        {"data", script_json(data)},
                                        {"library", std::string(assets::library_js())},
                                        {"script", std::string(assets::script_js())}});
}

void require_replaceable(const std::filesystem::path& path) {
  // A text from the head of the template, which identifies a page of this kind.
  require_own_kind(path,
                   "script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: blob:", "report");
}

void write_page(const std::filesystem::path& path, const std::string& html) {
  require_replaceable(path);
  PartFile file(path);
  file.write({reinterpret_cast<const std::uint8_t*>(html.data()), html.size()});
  file.commit();
}

}  // namespace astro::report
