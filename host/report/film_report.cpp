#include "host/report/film_report.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "host/report/html.hpp"
#include "host/report/page.hpp"

namespace astro::report {

namespace {

constexpr double kWidth = 720, kHeight = 360, kLeft = 64, kRight = 16, kTop = 12, kBottom = 44;
constexpr std::size_t kMostPoints = 3000;
constexpr std::array<const char*, 4> kColours{"#2a6fdb", "#d1495b", "#3a9d5d", "#b07d12"};

struct Range {
  double low = INFINITY, high = -INFINITY;
  void add(double value) {
    if (!std::isfinite(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  void widen(double to) {
    const double more = (to - (high - low)) / 2;
    if (more > 0) low -= more, high += more;
  }
};

struct Axes {
  Range x, y;
  double height = kHeight;
  double right(double value) const {
    return kLeft + (value - x.low) / (x.high - x.low) * (kWidth - kLeft - kRight);
  }
  double down(double value) const {
    return height - kBottom - (value - y.low) / (y.high - y.low) * (height - kTop - kBottom);
  }
};

/// 1, 2 or 5 times a power of ten, about five in the range.
double step_for(const Range& range) {
  const double rough = (range.high - range.low) / 5, power = std::pow(10, std::floor(std::log10(rough)));
  for (const double times : {1.0, 2.0, 5.0})
    if (rough <= times * power) return times * power;
  return 10 * power;
}

Axes axes_of(const Plot& plot) {
  Axes axes;
  for (const PlotLine& line : plot.lines) {
    for (const double value : line.x) axes.x.add(value);
    for (const double value : line.y) axes.y.add(value);
  }
  for (Range* range : {&axes.x, &axes.y}) {
    range->widen(1e-9 + 1e-6 * std::abs(range->high));
    range->widen(1.06 * (range->high - range->low));
  }
  if (!plot.equal_axes) return axes;
  const double per_px = (axes.x.high - axes.x.low) / (kWidth - kLeft - kRight);
  axes.y.widen(per_px * 120);
  axes.height = kTop + kBottom + std::min(1200.0, (axes.y.high - axes.y.low) / per_px);
  axes.y.widen(per_px * (axes.height - kTop - kBottom));
  return axes;
}

std::string label(double x, double y, const char* anchor, const std::string& text) {
  return fmt::format(R"(<text x="{:.1f}" y="{:.1f}" text-anchor="{}">{}</text>)", x, y, anchor, escape(text));
}

std::string frame_of(const Axes& axes, const Plot& plot) {
  std::string svg = fmt::format(
      R"(<rect x="{}" y="{}" width="{:.1f}" height="{:.1f}" fill="none" stroke="currentColor" stroke-opacity="0.4"/>)",
      kLeft, kTop, kWidth - kLeft - kRight, axes.height - kTop - kBottom);
  const auto number = [](double value, double step) {
    return fmt::format("{:.6g}", std::abs(value) < step / 2 ? 0 : value);
  };
  const double dx = step_for(axes.x), dy = step_for(axes.y);
  for (double at = std::ceil(axes.x.low / dx) * dx; at <= axes.x.high; at += dx)
    svg += label(axes.right(at), axes.height - kBottom + 16, "middle", number(at, dx));
  for (double at = std::ceil(axes.y.low / dy) * dy; at <= axes.y.high; at += dy)
    svg += label(kLeft - 6, axes.down(at) + 4, "end", number(at, dy));
  svg += label((kLeft + kWidth - kRight) / 2, axes.height - 8, "middle", plot.x_name);
  return svg +
         fmt::format(
             R"svg(<text transform="translate(14 {:.1f}) rotate(-90)" text-anchor="middle">{}</text>)svg",
             (axes.height - kBottom + kTop) / 2, escape(plot.y_name));
}

std::string points_of(const Axes& axes, const PlotLine& line, const char* colour) {
  std::string svg;
  for (std::size_t i = 0; i < line.x.size(); ++i) {
    if (!std::isfinite(line.x[i]) || !std::isfinite(line.y[i])) continue;
    const double x = axes.right(line.x[i]), y = axes.down(line.y[i]);
    svg += fmt::format(R"(<circle cx="{:.1f}" cy="{:.1f}" r="4" fill="{}"/>)", x, y, colour);
    if (i < line.labels.size()) svg += label(x + 7, y - 5, "start", line.labels[i]);
  }
  return svg;
}

std::string path_of(const Axes& axes, const PlotLine& line, const char* colour) {
  std::string path;
  bool drawn = false;
  const std::size_t stride = line.x.size() / kMostPoints + 1;
  for (std::size_t i = 0; i < line.x.size(); i += stride) {
    if (!std::isfinite(line.x[i]) || !std::isfinite(line.y[i])) {
      drawn = false;
      continue;
    }
    path += fmt::format("{}{:.1f} {:.1f}", drawn ? 'L' : 'M', axes.right(line.x[i]), axes.down(line.y[i]));
    drawn = true;
  }
  return fmt::format(R"(<path d="{}" fill="none" stroke="{}" stroke-width="1.4"/>)", path, colour);
}

/// A figure that needs no script: SVG inside <figure>, with a frame, round numbers at the axes, and each line in a colour of its
/// own. At most about 3000 points of each line are drawn. Texts are escaped. "" if there is nothing finite to show.
std::string svg_figure(const Plot& plot) {
  const Axes axes = axes_of(plot);
  if (!std::isfinite(axes.x.low) || !std::isfinite(axes.y.low)) return "";
  std::string svg;
  for (std::size_t i = 0; i < plot.lines.size(); ++i) {
    const char* colour = kColours[i % kColours.size()];
    svg +=
        plot.lines[i].points ? points_of(axes, plot.lines[i], colour) : path_of(axes, plot.lines[i], colour);
  }
  return fmt::format(
      R"(<figure><figcaption>{}</figcaption><svg viewBox="0 0 {} {:.0f}" role="img" aria-label="{}" font-size="12" fill="currentColor">{}{}</svg></figure>
)",
      escape(plot.caption), kWidth, axes.height, escape(plot.caption), frame_of(axes, plot), svg);
}

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
