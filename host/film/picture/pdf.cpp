#include "host/film/picture/pdf.hpp"

#include <cairo/cairo-pdf.h>
#include <cairo/cairo.h>

#include <memory>

#include "host/base/error.hpp"

namespace astro::film::paper {
namespace {

constexpr double kPointsPerMm = 72 / 25.4;

cairo_status_t append(void* bytes, const unsigned char* data, unsigned length) {
  auto& all = *static_cast<Bytes*>(bytes);
  all.insert(all.end(), data, data + length);
  return CAIRO_STATUS_SUCCESS;
}

void require(cairo_status_t status) {
  if (status != CAIRO_STATUS_SUCCESS)
    throw Error(std::string("the pages of the PDF cannot be made: ") + cairo_status_to_string(status));
}

}  // namespace

Bytes pdf_of(const std::vector<Sheet>& sheets, const Paper& paper, const std::string& title) {
  Bytes bytes;
  const std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> surface(
      cairo_pdf_surface_create_for_stream(append, &bytes, paper.width_mm * kPointsPerMm,
                                          paper.height_mm * kPointsPerMm),
      &cairo_surface_destroy);
  require(cairo_surface_status(surface.get()));
  cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_TITLE, title.c_str());
  {
    const std::unique_ptr<cairo_t, decltype(&cairo_destroy)> context(cairo_create(surface.get()),
                                                                     &cairo_destroy);
    for (const Sheet& sheet : sheets) {
      Canvas canvas(context.get(), kPointsPerMm);
      std::visit([&](const auto& content) { draw(canvas, content, paper); }, sheet);
      cairo_show_page(context.get());
    }
    require(cairo_status(context.get()));
  }
  cairo_surface_finish(surface.get());
  require(cairo_surface_status(surface.get()));
  return bytes;
}

}  // namespace astro::film::paper
