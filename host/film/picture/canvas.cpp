#include "host/film/picture/canvas.hpp"

#include <cairo/cairo.h>

#include <array>

#ifdef ASTRO_SANITIZE
// The font library keeps its cache until the program ends. It stores pointers as offsets, so the leak checker
// reports this memory as lost.
extern "C" const char* __lsan_default_suppressions() { return "leak:libfontconfig"; }  // NOLINT
extern "C" const char* __lsan_default_options() { return "print_suppressions=0"; }     // NOLINT
#endif

namespace astro::film::paper {

std::optional<Paper> paper_named(std::string_view name) {
  for (const Paper& paper : {kA4, kLetter})
    if (paper.name == name) return paper;
  return std::nullopt;
}

Canvas::Canvas(_cairo* context, double units_per_mm) : context_(context) {
  cairo_save(context_);
  cairo_scale(context_, units_per_mm, units_per_mm);
}

Canvas::~Canvas() { cairo_restore(context_); }

void Canvas::fill(const std::vector<Rectangle>& parts, double grey) {
  for (const Rectangle& part : parts)
    cairo_rectangle(context_, part.x_mm, part.y_mm, part.width_mm, part.height_mm);
  cairo_set_source_rgb(context_, grey, grey, grey);
  cairo_fill(context_);
}

void Canvas::polygon(const std::vector<Place>& corners, double grey) {
  for (const Place& corner : corners) cairo_line_to(context_, corner.x_mm, corner.y_mm);
  cairo_close_path(context_);
  cairo_set_source_rgb(context_, grey, grey, grey);
  cairo_fill(context_);
}

void Canvas::line(Place from, Place to, double width_mm, double grey) {
  cairo_set_line_width(context_, width_mm);
  cairo_set_source_rgb(context_, grey, grey, grey);
  cairo_move_to(context_, from.x_mm, from.y_mm);
  cairo_line_to(context_, to.x_mm, to.y_mm);
  cairo_stroke(context_);
}

void Canvas::dashed(const Rectangle& frame, double width_mm, double grey) {
  constexpr std::array kDash_mm{2.0, 2.0};
  cairo_set_dash(context_, kDash_mm.data(), static_cast<int>(kDash_mm.size()), 0);
  cairo_set_line_width(context_, width_mm);
  cairo_set_source_rgb(context_, grey, grey, grey);
  cairo_rectangle(context_, frame.x_mm, frame.y_mm, frame.width_mm, frame.height_mm);
  cairo_stroke(context_);
  cairo_set_dash(context_, nullptr, 0, 0);
}

void Canvas::text(Place at, const std::string& words, double size_mm, Align align, Weight weight) {
  const double width_mm = width_of(words, size_mm, weight);
  const double left_mm = at.x_mm - (align == Align::right    ? width_mm
                                    : align == Align::centre ? width_mm / 2
                                                             : 0);
  cairo_set_source_rgb(context_, 0, 0, 0);
  cairo_move_to(context_, left_mm, at.y_mm);
  cairo_show_text(context_, words.c_str());
}

double Canvas::width_of(const std::string& words, double size_mm, Weight weight) {
  choose_font(size_mm, weight);
  cairo_text_extents_t extents;
  cairo_text_extents(context_, words.c_str(), &extents);
  return extents.x_advance;
}

void Canvas::choose_font(double size_mm, Weight weight) {
  cairo_select_font_face(context_, "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                         weight == Weight::bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(context_, size_mm);
}

}  // namespace astro::film::paper
