#include "host/film/picture/tag_sheet.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "host/base/error.hpp"
#include "host/film/picture/tag_picture.hpp"

namespace astro::film::paper {
namespace {

constexpr double kSmallest_mm = 10;
// Above the white margin: title and arrow. Below it: the ruler and three notes. Printers leave out 4 to 6 mm at the edges.
constexpr double kHead_mm = 18, kFoot_mm = 45, kSafe_mm = 6;
constexpr double kLeastWidth_mm = 130;  // for the words

double with_margin_mm(double side_mm) { return side_mm * (kCells + 2) / kCells; }

void check(const TagSheet& sheet, const Paper& paper) {
  const double most_mm = largest_side_mm(paper);
  if (sheet.side_mm >= kSmallest_mm && sheet.side_mm <= most_mm) return;
  throw Error(fmt::format("a tag of {:g} mm cannot be on paper of {:g} mm x {:g} mm: {:g} to {:g} mm can",
                          sheet.side_mm, paper.width_mm, paper.height_mm, kSmallest_mm, most_mm));
}

/// The corner of a cell in the drawing. The robot's tag is turned by a quarter turn, so that its right side
/// is up.
Place corner_of(const TagSheet& sheet, int row, int column) {
  return sheet.role == TagRole::robot
             ? Place{static_cast<double>(row), static_cast<double>(kCells - 1 - column)}
             : Place{static_cast<double>(column), static_cast<double>(row)};
}

void draw_tag(Canvas& canvas, const TagSheet& sheet, Place centre) {
  const TagPicture picture = tag_picture(sheet.id);
  const double cell_mm = sheet.side_mm / kCells;
  const Place corner{centre.x_mm - sheet.side_mm / 2, centre.y_mm - sheet.side_mm / 2};
  std::vector<Rectangle> black;
  for (int row = 0; row < kCells; ++row) {
    for (int column = 0; column < kCells; ++column) {
      if (picture.white(row, column)) continue;
      const Place cell = corner_of(sheet, row, column);
      black.push_back(
          {corner.x_mm + cell.x_mm * cell_mm, corner.y_mm + cell.y_mm * cell_mm, cell_mm, cell_mm});
    }
  }
  canvas.fill(black, 0);
  // Grey, so that it shows on both black and white; far too thin to change how a camera reads the cells.
  const double arm_mm = std::min(3.0, cell_mm / 4);
  canvas.line({centre.x_mm - arm_mm, centre.y_mm}, {centre.x_mm + arm_mm, centre.y_mm}, 0.3, 0.5);
  canvas.line({centre.x_mm, centre.y_mm - arm_mm}, {centre.x_mm, centre.y_mm + arm_mm}, 0.3, 0.5);
}

constexpr double kRuler_mm = 100;

/// A ruler of kRuler_mm with a mark each millimetre and a number each ten, by which a person checks the printer's scale. The
/// marks stand on a line that begins at `zero`; numbers are below it.
void draw_ruler(Canvas& canvas, Place zero) {
  constexpr double kMark_mm = 0.15;
  // The line ends where the outer marks do.
  canvas.line({zero.x_mm - kMark_mm / 2, zero.y_mm}, {zero.x_mm + kRuler_mm + kMark_mm / 2, zero.y_mm}, 0.2);
  for (int mm = 0; mm <= static_cast<int>(kRuler_mm); ++mm) {
    const double height_mm = mm % 10 == 0 ? 5 : mm % 5 == 0 ? 3.5 : 2;
    const double x_mm = zero.x_mm + mm;
    canvas.line({x_mm, zero.y_mm - height_mm}, {x_mm, zero.y_mm}, kMark_mm);
    if (mm % 10 == 0) canvas.text({x_mm, zero.y_mm + 3.6}, std::to_string(mm), 2.8, Align::centre);
  }
  canvas.text({zero.x_mm + kRuler_mm + 3.5, zero.y_mm + 3.6}, "mm", 2.8);
}

void draw_head(Canvas& canvas, const TagSheet& sheet, double middle_mm, double width_mm) {
  const bool robot = sheet.role == TagRole::robot;
  constexpr double kTip_mm = 7.5, kBase_mm = 13.5, kText_mm = 3.2;
  const Place tip{middle_mm, kTip_mm};
  canvas.polygon({tip, {middle_mm + 3.5, kTip_mm + 3.5}, {middle_mm - 3.5, kTip_mm + 3.5}}, 0);
  canvas.fill({{middle_mm - 1, kTip_mm + 3.5, 2, kBase_mm - kTip_mm - 3.5}}, 0);
  canvas.text({middle_mm, kBase_mm + 3.5}, robot ? "front of the robot" : "top of the tag", kText_mm,
              Align::centre);
  const double left_mm = middle_mm - width_mm / 2 + 2, right_mm = middle_mm + width_mm / 2 - 2;
  canvas.text({left_mm, kBase_mm}, fmt::format("{} tag {}", robot ? "Robot" : "Floor", sheet.id), 6,
              Align::left, Weight::bold);
  canvas.text({right_mm, kBase_mm - 1}, fmt::format("tag36h11, id {}", sheet.id), kText_mm, Align::right);
  canvas.text({right_mm, kBase_mm + 3.5}, fmt::format("black square {:g} mm", sheet.side_mm), kText_mm,
              Align::right);
}

}  // namespace

double largest_side_mm(const Paper& paper) {
  const double room_mm = std::min(paper.width_mm, paper.height_mm - kHead_mm - kFoot_mm);
  return std::floor(room_mm * kCells / (kCells + 2));
}

Place tag_centre(const TagSheet& sheet, const Paper& paper) {
  return {paper.width_mm / 2, kHead_mm + with_margin_mm(sheet.side_mm) / 2};
}

void draw(Canvas& canvas, const TagSheet& sheet, const Paper& paper) {
  check(sheet, paper);
  const Place centre = tag_centre(sheet, paper);
  const double margin_mm = with_margin_mm(sheet.side_mm);
  const double width_mm = std::min(std::max(margin_mm, kLeastWidth_mm), paper.width_mm - 2 * kSafe_mm);
  draw_tag(canvas, sheet, centre);
  draw_head(canvas, sheet, centre.x_mm, width_mm);
  const double below_mm = kHead_mm + margin_mm;
  // A cutting line around the head and the tag with its margin, for a robot that is smaller than the sheet.
  const double cut_mm = std::max(margin_mm, kLeastWidth_mm) + 2;
  if (sheet.role == TagRole::robot && cut_mm <= paper.width_mm - 2 * kSafe_mm)
    canvas.dashed({centre.x_mm - cut_mm / 2, kSafe_mm, cut_mm, below_mm + 1 - kSafe_mm}, 0.2, 0.6);
  draw_ruler(canvas, {centre.x_mm - kRuler_mm / 2, below_mm + 14});
  double line_mm = below_mm + 26;
  for (const std::string& note : sheet.notes) {
    canvas.text({centre.x_mm, line_mm}, note, 3.2, Align::centre);
    line_mm += 4.8;
  }
}

}  // namespace astro::film::paper
