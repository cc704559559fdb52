#include "host/film/track/film_diagnosis.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <optional>

#include "host/film/picture/detector.hpp"
#include "host/film/picture/frame_stream.hpp"

namespace astro::film {
namespace {

constexpr int kPictures = 6;
constexpr std::size_t kMostPixels = std::size_t{6} << 20;  // a larger picture need not be enlarged

GrayFrame mirrored(const GrayFrame& frame) {
  GrayFrame other = frame;
  for (int y = 0; y < frame.height; ++y) {
    const auto row = other.pixels.begin() + static_cast<long>(y) * frame.width;
    std::reverse(row, row + frame.width);
  }
  return other;
}

/// Enlarges a picture to twice its size, bilinearly.
GrayFrame enlarged(const GrayFrame& frame) {
  GrayFrame other{2 * frame.width, 2 * frame.height, {}, frame.pts_s, frame.key};
  other.pixels.resize(4 * frame.pixels.size());
  for (int y = 0; y < other.height; ++y)
    for (int x = 0; x < other.width; ++x) {
      const int left = x / 2, top = y / 2;
      const int right = std::min(left + x % 2, frame.width - 1),
                bottom = std::min(top + y % 2, frame.height - 1);
      const int sum =
          frame.at(left, top) + frame.at(right, top) + frame.at(left, bottom) + frame.at(right, bottom);
      other.pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(other.width) +
                   static_cast<std::size_t>(x)] = static_cast<std::uint8_t>((sum + 2) / 4);
    }
  return other;
}

std::optional<double> side_of(TagDetector& detector, const GrayFrame& frame, double decimate,
                              const std::function<bool(int)>& wanted) {
  for (const DetectedTag& tag : detector.detect(frame, whole_of(frame), decimate))
    if (wanted(tag.id)) return shortest_side(tag.corners);
  return std::nullopt;
}

/// Compares the largest brightness steps over one pixel with those over sixteen. In a sharp picture they are
/// about equal; in one that is out of focus those over one pixel are far smaller.
bool is_blurred(const GrayFrame& frame) {
  constexpr int kFar_px = 16;
  constexpr double kGreatest = 0.002;  // part of the picture with the largest steps: the edges of some tags
  constexpr int kContrast = 50;        // a smaller step shows nothing, or is noise
  constexpr double kSoft =
      0.2;  // a lens with 0.7 px gives 0.55, one with 2 px, at which tags cannot be read, 0.2
  std::array<std::size_t, 256> near{}, far{};
  for (int y = 0; y < frame.height; ++y)
    for (int x = 0; x + kFar_px < frame.width; ++x) {
      ++near[static_cast<std::size_t>(std::abs(frame.at(x, y) - frame.at(x + 1, y)))];
      ++far[static_cast<std::size_t>(std::abs(frame.at(x, y) - frame.at(x + kFar_px, y)))];
    }
  const auto greatest = [&](const std::array<std::size_t, 256>& steps) {
    const double part = kGreatest * static_cast<double>(frame.pixels.size());
    std::size_t count = 0;
    int step = 255;
    while (step > 0 && static_cast<double>(count += steps[static_cast<std::size_t>(step)]) < part) --step;
    return step;
  };
  return greatest(far) >= kContrast && greatest(near) < kSoft * greatest(far);
}

}  // namespace

TagDiagnosis why_no_tag(const std::filesystem::path& film, const FilmInfo& info,
                        const std::function<bool(int)>& wanted) {
  FrameStream stream(film, info, FrameStream::Pictures::key_only);
  TagDetector detector;
  GrayFrame frame;
  TagDiagnosis found;
  bool blurred = false;
  for (int i = 0; i < kPictures && stream.next(frame); ++i) {
    blurred = blurred || (is_blurred(frame) && detector.detect(frame, whole_of(frame), 1).empty());
    if (side_of(detector, mirrored(frame), 1, wanted)) return {TagProblem::mirrored, 0};
    for (const double coarse : {2.0, 3.0, 4.0})
      if (const auto side = side_of(detector, frame, coarse, wanted)) found = {TagProblem::blurred, *side};
    if (found.problem != TagProblem::none_there || frame.pixels.size() > kMostPixels) continue;
    if (const auto side = side_of(detector, enlarged(frame), 1, wanted))
      found = {TagProblem::too_small, *side / 2};
  }
  if (found.problem == TagProblem::none_there && blurred) found.problem = TagProblem::blurred;
  return found;
}

}  // namespace astro::film
