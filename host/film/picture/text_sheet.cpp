#include "host/film/picture/text_sheet.hpp"

#include <sstream>

namespace astro::film::paper {
namespace {

constexpr double kMargin_mm = 18, kText_mm = 3.9, kLine_mm = 5.6, kBetween_mm = 2.6, kIndent_mm = 8;

/// Breaks one line of the text into lines no wider than `width_mm`.
std::vector<std::string> broken(Canvas& canvas, const std::string& line, double width_mm) {
  std::vector<std::string> lines(1);
  std::istringstream words(line);
  for (std::string word; words >> word;) {
    const std::string longer = lines.back().empty() ? word : lines.back() + ' ' + word;
    if (lines.back().empty() || canvas.width_of(longer, kText_mm) <= width_mm) {
      lines.back() = longer;
    } else {
      lines.push_back(word);
    }
  }
  return lines;
}

}  // namespace

double draw(Canvas& canvas, const TextSheet& sheet, const Paper& paper) {
  double y_mm = kMargin_mm + 4;
  canvas.text({kMargin_mm, y_mm}, sheet.title, 7, Align::left, Weight::bold);
  y_mm += 5;
  for (const Paragraph& paragraph : sheet.paragraphs) {
    y_mm += kBetween_mm;
    if (!paragraph.heading.empty()) {
      y_mm += kLine_mm;
      canvas.text({kMargin_mm, y_mm}, paragraph.heading, kText_mm, Align::left, Weight::bold);
    }
    std::istringstream text(paragraph.text);
    for (std::string line; std::getline(text, line);) {
      const double left_mm = kMargin_mm + (line.starts_with(' ') ? kIndent_mm : 0);
      for (const std::string& part : broken(canvas, line, paper.width_mm - kMargin_mm - left_mm)) {
        y_mm += kLine_mm;
        canvas.text({left_mm, y_mm}, part, kText_mm);
      }
    }
  }
  return y_mm;
}

}  // namespace astro::film::paper
