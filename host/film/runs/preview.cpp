#include "host/film/runs/preview.hpp"

#include <zlib.h>

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <string>
#include <string_view>

#include "host/film/picture/frame_stream.hpp"
#include "host/film/picture/gray_frame.hpp"

namespace astro::film {
namespace {

struct Colour {
  std::uint8_t red, green, blue;
};

/// A colour picture to draw on. What lies outside is cut off.
class Canvas {
 public:
  explicit Canvas(const GrayFrame& frame);

  /// Two pixels wide.
  void line(const Eigen::Vector2d& from, const Eigen::Vector2d& to, Colour colour);
  /// Digits, 15 by 21 px each, from the top left corner `at` on.
  void number(const Eigen::Vector2d& at, int value, Colour colour);

  /// As a PNG file.
  std::vector<std::uint8_t> png() const;

 private:
  void dot(int x, int y, Colour colour);

  int width_, height_;
  std::vector<std::uint8_t> pixels_;  // red, green, blue
};

/// Rows of five pixels from the top, the leftmost in the highest of five bits.
constexpr std::array<std::array<std::uint8_t, 7>, 10> kDigits{{{14, 17, 19, 21, 25, 17, 14},
                                                               {4, 12, 4, 4, 4, 4, 14},
                                                               {14, 17, 1, 2, 4, 8, 31},
                                                               {31, 2, 4, 2, 1, 17, 14},
                                                               {2, 6, 10, 18, 31, 2, 2},
                                                               {31, 16, 30, 1, 1, 17, 14},
                                                               {6, 8, 16, 30, 17, 17, 14},
                                                               {31, 1, 2, 4, 8, 8, 8},
                                                               {14, 17, 17, 14, 17, 17, 14},
                                                               {14, 17, 17, 15, 1, 2, 12}}};
constexpr int kDot = 3;  // pixels for one of a digit

void append(std::vector<std::uint8_t>& to, std::uint32_t value) {
  for (const int shift : {24, 16, 8, 0}) to.push_back(static_cast<std::uint8_t>(value >> shift));
}

void append_chunk(std::vector<std::uint8_t>& png, std::string_view type,
                  const std::vector<std::uint8_t>& data) {
  append(png, static_cast<std::uint32_t>(data.size()));
  const std::size_t begin = png.size();
  png.insert(png.end(), type.begin(), type.end());
  png.insert(png.end(), data.begin(), data.end());
  append(png,
         static_cast<std::uint32_t>(crc32(0, png.data() + begin, static_cast<uInt>(png.size() - begin))));
}

Canvas::Canvas(const GrayFrame& frame) : width_(frame.width), height_(frame.height) {
  pixels_.reserve(3 * frame.pixels.size());
  for (const std::uint8_t value : frame.pixels) pixels_.insert(pixels_.end(), 3, value);
}

void Canvas::dot(int x, int y, Colour colour) {
  if (x < 0 || y < 0 || x >= width_ || y >= height_) return;
  const std::size_t at =
      3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x));
  pixels_[at] = colour.red;
  pixels_[at + 1] = colour.green;
  pixels_[at + 2] = colour.blue;
}

void Canvas::line(const Eigen::Vector2d& from, const Eigen::Vector2d& to, Colour colour) {
  constexpr double kLongest_px = 20'000;  // what is far outside would take for ever
  const double length = (to - from).norm();
  if (!(length < kLongest_px) || !from.allFinite()) return;
  const int steps = static_cast<int>(2 * length) + 1;
  for (int i = 0; i <= steps; ++i) {
    const Eigen::Vector2d p = from + (to - from) * (static_cast<double>(i) / steps);
    if (!(p.cwiseAbs().maxCoeff() < kLongest_px)) continue;
    const int x = static_cast<int>(std::lround(p.x())), y = static_cast<int>(std::lround(p.y()));
    for (const int right : {0, 1})
      for (const int down : {0, 1}) dot(x + right, y + down, colour);
  }
}

void Canvas::number(const Eigen::Vector2d& at, int value, Colour colour) {
  int left = static_cast<int>(at.x());
  const int top = static_cast<int>(at.y());
  for (const char digit : std::to_string(value)) {
    if (digit < '0' || digit > '9') continue;
    const auto& rows = kDigits[static_cast<std::size_t>(digit - '0')];
    for (int y = 0; y < 7 * kDot; ++y)
      for (int x = 0; x < 5 * kDot; ++x)
        if ((rows[static_cast<std::size_t>(y / kDot)] >> (4 - x / kDot) & 1) != 0)
          dot(left + x, top + y, colour);
    left += 6 * kDot;
  }
}

std::vector<std::uint8_t> Canvas::png() const {
  std::vector<std::uint8_t> rows;
  const std::size_t row_bytes = 3 * static_cast<std::size_t>(width_);
  for (std::size_t y = 0; y < static_cast<std::size_t>(height_); ++y) {
    rows.push_back(0);  // no filter
    const auto row = pixels_.begin() + static_cast<long>(y * row_bytes);
    rows.insert(rows.end(), row, row + static_cast<long>(row_bytes));
  }
  uLongf packed_bytes = compressBound(rows.size());
  std::vector<std::uint8_t> packed(packed_bytes);
  compress2(packed.data(), &packed_bytes, rows.data(), rows.size(), 6);
  packed.resize(packed_bytes);
  std::vector<std::uint8_t> png{0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'}, header;
  append(header, static_cast<std::uint32_t>(width_));
  append(header, static_cast<std::uint32_t>(height_));
  header.insert(header.end(), {8, 2, 0, 0, 0});  // bits a channel, true colour
  append_chunk(png, "IHDR", header);
  append_chunk(png, "IDAT", packed);
  append_chunk(png, "IEND", {});
  return png;
}

constexpr Colour kFloor{0, 200, 60}, kRobot{230, 30, 30}, kPath{40, 120, 255};

void outline(Canvas& canvas, const TagCorners& corners, Colour colour) {
  for (std::size_t i = 0; i < 4; ++i) canvas.line(corners[i], corners[(i + 1) % 4], colour);
}

}  // namespace

std::vector<std::uint8_t> preview_png(const std::filesystem::path& film, const FilmTrack& track) {
  FrameStream stream(film, track.info, FrameStream::Pictures::key_only);
  GrayFrame frame;
  stream.next(frame);
  Canvas canvas(frame);
  const Scene& scene = track.scene;
  const auto seen = [&](const FilmPose& pose) {
    return project(scene.camera, {pose.pose.x_m, pose.pose.y_m, scene.robot_height_m});
  };
  const std::vector<FilmPose>& poses = track.found.poses;
  constexpr double kGap_s = 0.5;  // where the tag was hidden the path is not known
  for (std::size_t i = 1; i < poses.size(); ++i)
    if (poses[i].time_s - poses[i - 1].time_s < kGap_s)
      canvas.line(seen(poses[i - 1]), seen(poses[i]), kPath);
  for (std::size_t i = 0; i < scene.tags.size(); ++i) {
    const TagCorners corners = floor_corners(scene, i);
    outline(canvas, corners, kFloor);
    canvas.number(corners[2] + Eigen::Vector2d(6, -6), scene.tags[i].id, kFloor);
  }
  if (!poses.empty())
    outline(canvas, robot_corners(scene, poses.front().pose, {}, track.sightings.robot.front().corners),
            kRobot);
  return canvas.png();
}

}  // namespace astro::film
