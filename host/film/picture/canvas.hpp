#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

struct _cairo;  // cairo_t, so that nobody else has to include its header

namespace astro::film::paper {

/// A sheet of paper, upright.
struct Paper {
  std::string_view name;
  double width_mm, height_mm;
};

inline constexpr Paper kA4{"a4", 210, 297};
inline constexpr Paper kLetter{"letter", 215.9, 279.4};

/// The paper with this name; nothing if there is none.
std::optional<Paper> paper_named(std::string_view name);

/// A place on a sheet: millimetres from its upper left corner, x right, y down.
struct Place {
  double x_mm = 0, y_mm = 0;
};

struct Rectangle {
  double x_mm = 0, y_mm = 0, width_mm = 0, height_mm = 0;
};

enum class Align { left, centre, right };
enum class Weight { normal, bold };

/// Shapes and text in grey, drawn through cairo into a page of a PDF or into an image. The same calls give the same sheet on
/// both.
///
/// Errors  none; whoever owns the cairo surface asks it for its status.
class Canvas {
 public:
  /// `units_per_mm` of the surface: points of a PDF, pixels of an image. Does not take ownership.
  Canvas(_cairo* context, double units_per_mm);
  ~Canvas();
  Canvas(const Canvas&) = delete;
  Canvas& operator=(const Canvas&) = delete;

  /// Grey is 0 for black and 1 for white.
  void fill(const std::vector<Rectangle>& parts, double grey);
  void polygon(const std::vector<Place>& corners, double grey);
  void line(Place from, Place to, double width_mm, double grey = 0);
  void dashed(const Rectangle& frame, double width_mm, double grey);
  /// One line; `at` is on its base line. `size_mm` is the height of the font.
  void text(Place at, const std::string& words, double size_mm, Align align = Align::left,
            Weight weight = Weight::normal);
  double width_of(const std::string& words, double size_mm, Weight weight = Weight::normal);

 private:
  void choose_font(double size_mm, Weight weight);

  _cairo* context_;
};

}  // namespace astro::film::paper
