#include "host/report/film_report.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "host/report/html.hpp"
#include "host/report/page.hpp"

namespace astro::report {
namespace {

/// RFC 4648.
std::string base64(const std::vector<std::uint8_t>& bytes) {
  static constexpr char kLetters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = std::uint32_t{bytes[i]} << 16;
    if (i + 1 < bytes.size()) group |= std::uint32_t{bytes[i + 1]} << 8;
    if (i + 2 < bytes.size()) group |= bytes[i + 2];
    for (std::size_t k = 0; k < 4; ++k)
      text += i + k <= bytes.size() ? kLetters[group >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

Section picture(const FilmReportInput& input) {
  Section out{"picture", "The first picture", ""};
  if (input.preview_png.empty()) return out;
  out.body =
      R"(<p>As the camera is understood: tags on the floor green, with their numbers; the robot's tag red; its path blue.
The outlines should lie on the edges of the black squares.</p><img style="max-width:100%" alt="The first picture with the tags outlined" src="data:image/png;base64,)" +
      base64(input.preview_png) + "\">";
  return out;
}

Section found(const FilmReportInput& input) {
  Section out{"found", "What the film shows", "<dl>"};
  for (const auto& [name, value] : input.description)
    out.body += fmt::format("<dt>{}</dt><dd>{}</dd>\n", escape(name), escape(value));
  out.body += "</dl>";
  if (input.remarks.empty()) return out;
  out.body += "<ul>";
  for (const std::string& remark : input.remarks) out.body += "<li>" + escape(remark) + "</li>\n";
  out.body += "</ul>";
  return out;
}

Section plots(const FilmReportInput& input) {
  Section out{"plots", "Over the film", ""};
  for (const Plot& plot : input.plots) out.body += svg_figure(plot);
  return out;
}

}  // namespace

std::string render_film_html(const FilmReportInput& input) {
  const nlohmann::json none = nlohmann::json::array();
  return render_page(input.title, {found(input), picture(input), plots(input)},
                     {{"phases", none}, {"clusters", none}, {"groups", none}});
}

}  // namespace astro::report
