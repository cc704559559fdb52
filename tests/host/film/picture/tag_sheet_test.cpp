#include "host/film/picture/tag_sheet.hpp"

#include <cairo/cairo.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "host/base/error.hpp"
#include "host/film/picture/pdf.hpp"
#include "host/film/picture/tag_picture.hpp"
#include "tests/support/tags/read_tags.hpp"

// What is printed is what cameras and libraries of others take for the same tag.
namespace astro::film::paper {
namespace {

using support::PicturePoint;
using support::ReadTag;

constexpr double kPixelsPerMm = 6;  // about 150 dpi

class Picture {
 public:
  explicit Picture(const TagSheet& sheet, const Paper& paper = kA4)
      : width_(px(paper.width_mm)), height_(px(paper.height_mm)) {
    const std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> surface(
        cairo_image_surface_create(CAIRO_FORMAT_RGB24, width_, height_), &cairo_surface_destroy);
    const std::unique_ptr<cairo_t, decltype(&cairo_destroy)> context(cairo_create(surface.get()),
                                                                     &cairo_destroy);
    cairo_set_source_rgb(context.get(), 1, 1, 1);
    cairo_paint(context.get());
    {
      Canvas canvas(context.get(), kPixelsPerMm);
      draw(canvas, sheet, paper);
    }
    cairo_surface_flush(surface.get());
    const unsigned char* const data = cairo_image_surface_get_data(surface.get());
    const int stride = cairo_image_surface_get_stride(surface.get());
    for (int row = 0; row < height_; ++row)
      for (int column = 0; column < width_; ++column) grey_.push_back(data[row * stride + 4 * column]);
  }

  std::vector<ReadTag> tags() const { return support::read_tags(grey_, width_, height_); }
  std::uint8_t at(double x_mm, double y_mm) const {
    return grey_[static_cast<std::size_t>(px(y_mm) * width_ + px(x_mm))];
  }
  /// The darkest pixel in a rectangle.
  int darkest(const Rectangle& part) const {
    int least = 255;
    for (double y_mm = part.y_mm; y_mm < part.y_mm + part.height_mm; y_mm += 1 / kPixelsPerMm)
      for (double x_mm = part.x_mm; x_mm < part.x_mm + part.width_mm; x_mm += 1 / kPixelsPerMm)
        least = std::min<int>(least, at(x_mm, y_mm));
    return least;
  }

 private:
  static int px(double mm) { return static_cast<int>(mm * kPixelsPerMm); }

  int width_, height_;
  std::vector<std::uint8_t> grey_;
};

double distance_mm(const PicturePoint& a, const PicturePoint& b) {
  return std::hypot(a.x_px - b.x_px, a.y_px - b.y_px) / kPixelsPerMm;
}

/// Where the tag's x axis points on the sheet: 0 to the right, 90 degrees up.
double x_axis_deg(const ReadTag& tag) {
  const PicturePoint from = tag.corners[0], to = tag.corners[1];
  return std::atan2(from.y_px - to.y_px, to.x_px - from.x_px) * 180 / M_PI;
}

struct Case {
  TagSheet sheet;
  Paper paper;
};

class PrintedTag : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(
    Sheets, PrintedTag,
    testing::Values(Case{{TagRole::robot, 0, 120, {}}, kA4}, Case{{TagRole::robot, 7, 140, {}}, kLetter},
                    Case{{TagRole::floor, 1, 160, {}}, kA4}, Case{{TagRole::floor, 6, 160, {}}, kLetter},
                    Case{{TagRole::floor, 586, 60, {}}, kA4},
                    Case{{TagRole::robot, 100, largest_side_mm(kA4), {}}, kA4}),
    [](const auto& each) {
      return "id" + std::to_string(each.param.sheet.id) + std::string(each.param.paper.name);
    });

TEST_P(PrintedTag, IsReadByLibapriltagWithItsIdAndNoWrongBit) {
  const auto tags = Picture(GetParam().sheet, GetParam().paper).tags();
  ASSERT_EQ(tags.size(), 1U);
  EXPECT_EQ(tags[0].id, GetParam().sheet.id);
  EXPECT_EQ(tags[0].wrong_bits, 0);
}

TEST_P(PrintedTag, HasItsSizeAndPlaceInMillimetres) {
  const auto& [sheet, paper] = GetParam();
  const ReadTag tag = Picture(sheet, paper).tags().at(0);
  // libapriltag's corners are off by up to 0.4 px, which is 0.07 mm.
  for (std::size_t corner = 0; corner < 4; ++corner)
    EXPECT_NEAR(distance_mm(tag.corners[corner], tag.corners[(corner + 1) % 4]), sheet.side_mm, 0.15);
  const Place centre = tag_centre(sheet, paper);
  double x_px = 0, y_px = 0;
  for (const PicturePoint& corner : tag.corners) x_px += corner.x_px / 4, y_px += corner.y_px / 4;
  EXPECT_NEAR((x_px + 0.5) / kPixelsPerMm, centre.x_mm, 0.1);
  EXPECT_NEAR((y_px + 0.5) / kPixelsPerMm, centre.y_mm, 0.1);
}

TEST_P(PrintedTag, PointsWhereTheArrowAtTheTopSays) {
  const auto& [sheet, paper] = GetParam();
  const ReadTag tag = Picture(sheet, paper).tags().at(0);
  // The robot's front is the tag's x axis; the top of a tag on the floor is its y axis.
  EXPECT_NEAR(x_axis_deg(tag), sheet.role == TagRole::robot ? 90 : 0, 0.2);
}

TEST_P(PrintedTag, HasAWhiteMarginOfACell) {
  const auto& [sheet, paper] = GetParam();
  const Picture picture(sheet, paper);
  const Place centre = tag_centre(sheet, paper);
  const double half_mm = sheet.side_mm / 2, cell_mm = sheet.side_mm / kCells;
  const double gap_mm = 0.2;  // a pixel, in which an edge is grey
  const double outer_mm = half_mm + cell_mm - gap_mm, width_mm = cell_mm - 2 * gap_mm;
  const double left_mm = centre.x_mm - outer_mm, top_mm = centre.y_mm - outer_mm;
  EXPECT_EQ(picture.darkest({left_mm, top_mm, 2 * outer_mm, width_mm}), 255);
  EXPECT_EQ(picture.darkest({left_mm, top_mm, width_mm, 2 * outer_mm}), 255);
  EXPECT_EQ(picture.darkest({left_mm, centre.y_mm + half_mm + gap_mm, 2 * outer_mm, width_mm}), 255);
  EXPECT_EQ(picture.darkest({centre.x_mm + half_mm + gap_mm, top_mm, width_mm, 2 * outer_mm}), 255);
}

TEST_P(PrintedTag, HasARulerOf100MillimetresBelow) {
  const auto& [sheet, paper] = GetParam();
  const Picture picture(sheet, paper);
  const Place centre = tag_centre(sheet, paper);
  // In a line of the picture that only the marks of whole centimetres reach.
  const double line_mm = centre.y_mm + sheet.side_mm * (kCells + 2) / kCells / 2 + 14 - 4.5;
  std::vector<double> marks_mm;
  for (double x_mm = centre.x_mm - 55; x_mm < centre.x_mm + 55; x_mm += 1 / kPixelsPerMm)
    if (picture.at(x_mm, line_mm) < 200 && (marks_mm.empty() || x_mm - marks_mm.back() > 1))
      marks_mm.push_back(x_mm);
  ASSERT_EQ(marks_mm.size(), 11U);
  EXPECT_NEAR(marks_mm.back() - marks_mm.front(), 100, 1.01 / kPixelsPerMm);  // each to a pixel
}

TEST(TagSheet, RefusesWhatDoesNotFitAndTagsThatDoNotExist) {
  EXPECT_THROW(Picture({TagRole::floor, 1, largest_side_mm(kA4) + 1, {}}, kA4), Error);
  EXPECT_THROW(Picture({TagRole::floor, 1, 9, {}}, kA4), Error);
  EXPECT_THROW(Picture({TagRole::floor, 1, std::nan(""), {}}, kA4), Error);
  EXPECT_THROW(Picture({TagRole::floor, kTagCount, 100, {}}, kA4), Error);
  EXPECT_THROW(Picture({TagRole::floor, -1, 100, {}}, kA4), Error);
}

TEST(TagPicture, HasABlackRingAndNeverTheSameCellsTwice) {
  const TagPicture first = tag_picture(0), other = tag_picture(1);
  int different = 0;
  for (int row = 0; row < kCells; ++row) {
    EXPECT_FALSE(first.white(row, 0) || first.white(row, kCells - 1));
    EXPECT_FALSE(first.white(0, row) || first.white(kCells - 1, row));
    for (int column = 0; column < kCells; ++column)
      different += first.white(row, column) != other.white(row, column) ? 1 : 0;
  }
  EXPECT_GE(different, 11);  // the 11 of tag36h11
}

TEST(Pdf, HasAPageForEachSheet) {
  const Bytes pdf = pdf_of({TextSheet{"Title", {{"Heading", "Some words."}}},
                            TagSheet{TagRole::robot, 0, 120, {"note"}}, TagSheet{TagRole::floor, 1, 160, {}}},
                           kLetter, "tags");
  const std::string text(as_text(pdf));
  EXPECT_TRUE(text.starts_with(kPdfMark));
  EXPECT_THAT(text, testing::HasSubstr("/Count 3"));
}

}  // namespace
}  // namespace astro::film::paper
