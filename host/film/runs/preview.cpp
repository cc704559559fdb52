#include "host/film/runs/preview.hpp"

#include <cairo/cairo.h>

#include <Eigen/Core>
#include <cmath>
#include <cstring>
#include <memory>
#include <string>

#include "host/base/error.hpp"
#include "host/film/picture/frame_stream.hpp"
#include "host/film/picture/gray_frame.hpp"

namespace astro::film {
namespace {

struct Colour {
  double red, green, blue;  // 0 to 1
};

constexpr Colour kFloor{0, 0.78, 0.24}, kRobot{0.9, 0.12, 0.12}, kPath{0.16, 0.47, 1};

cairo_status_t append(void* bytes, const unsigned char* data, unsigned length) {
  auto& all = *static_cast<std::vector<std::uint8_t>*>(bytes);
  all.insert(all.end(), data, data + length);
  return CAIRO_STATUS_SUCCESS;
}

void require(cairo_status_t status) {
  if (status != CAIRO_STATUS_SUCCESS)
    throw Error(std::string("the picture of the film cannot be drawn: ") + cairo_status_to_string(status));
}

/// A colour picture to draw on, in pixels of the film. What lies outside is cut off.
class Drawing {
 public:
  explicit Drawing(const GrayFrame& frame)
      : surface_(cairo_image_surface_create(CAIRO_FORMAT_RGB24, frame.width, frame.height),
                 &cairo_surface_destroy),
        context_(cairo_create(surface_.get()), &cairo_destroy) {
    require(cairo_status(context_.get()));
    copy(frame);
    cairo_translate(context_.get(), 0.5, 0.5);  // the centre of a film's first pixel is (0, 0)
    cairo_set_line_width(context_.get(), 2);
    cairo_set_line_join(context_.get(), CAIRO_LINE_JOIN_ROUND);
  }

  void line(const Eigen::Vector2d& from, const Eigen::Vector2d& to, Colour colour) {
    // A point behind the camera, or far beside the picture, cannot be drawn.
    constexpr double kFarthest_px = 20'000;
    if (!(from.cwiseAbs().maxCoeff() < kFarthest_px) || !(to.cwiseAbs().maxCoeff() < kFarthest_px)) return;
    choose(colour);
    cairo_move_to(context_.get(), from.x(), from.y());
    cairo_line_to(context_.get(), to.x(), to.y());
    cairo_stroke(context_.get());
  }

  void outline(const TagCorners& corners, Colour colour) {
    for (std::size_t i = 0; i < 4; ++i) line(corners[i], corners[(i + 1) % 4], colour);
  }

  /// `at`: the left end of the base line.
  void text(const Eigen::Vector2d& at, const std::string& words, Colour colour) {
    choose(colour);
    cairo_select_font_face(context_.get(), "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_BOLD);
    cairo_set_font_size(context_.get(), 28);
    cairo_move_to(context_.get(), at.x(), at.y());
    cairo_show_text(context_.get(), words.c_str());
  }

  std::vector<std::uint8_t> png() const {
    require(cairo_status(context_.get()));
    std::vector<std::uint8_t> bytes;
    require(cairo_surface_write_to_png_stream(surface_.get(), append, &bytes));
    return bytes;
  }

 private:
  void copy(const GrayFrame& frame) {
    cairo_surface_flush(surface_.get());
    unsigned char* to = cairo_image_surface_get_data(surface_.get());
    const int stride = cairo_image_surface_get_stride(surface_.get());
    for (int y = 0; y < frame.height; ++y)
      for (int x = 0; x < frame.width; ++x) {
        constexpr std::uint32_t kAllThree = 0x10101;
        const std::uint32_t pixel = kAllThree * frame.at(x, y);
        std::memcpy(to + static_cast<std::ptrdiff_t>(y) * stride + std::ptrdiff_t{4} * x, &pixel,
                    sizeof pixel);
      }
    cairo_surface_mark_dirty(surface_.get());
  }
  void choose(Colour colour) { cairo_set_source_rgb(context_.get(), colour.red, colour.green, colour.blue); }

  std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> surface_;
  std::unique_ptr<cairo_t, decltype(&cairo_destroy)> context_;
};

}  // namespace

std::vector<std::uint8_t> preview_png(const std::filesystem::path& film, const FilmTrack& track) {
  FrameStream stream(film, track.info, FrameStream::Pictures::key_only);
  GrayFrame frame;
  stream.next(frame);
  Drawing drawing(frame);
  const Scene& scene = track.scene;
  const auto seen = [&](const FilmPose& pose) {
    return project(scene.camera, {pose.pose.x_m, pose.pose.y_m, scene.robot_height_m});
  };
  const std::vector<FilmPose>& poses = track.found.poses;
  constexpr double kGap_s = 0.5;  // the path is not known where the tag was hidden
  for (std::size_t i = 1; i < poses.size(); ++i)
    if (poses[i].time_s - poses[i - 1].time_s < kGap_s)
      drawing.line(seen(poses[i - 1]), seen(poses[i]), kPath);
  for (std::size_t i = 0; i < scene.tags.size(); ++i) {
    const TagCorners corners = floor_corners(scene, i);
    drawing.outline(corners, kFloor);
    drawing.text(corners[2] + Eigen::Vector2d(6, 15), std::to_string(scene.tags[i].id), kFloor);
  }
  if (!poses.empty())
    drawing.outline(robot_corners(scene, poses.front().pose, {}, track.sightings.robot.front().corners),
                    kRobot);
  return drawing.png();
}

}  // namespace astro::film
