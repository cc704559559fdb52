#include "host/truth/film/preview/preview.hpp"

#include "host/truth/film/preview/canvas.hpp"
#include "host/truth/film/video/frame_stream.hpp"

namespace astro::film {
namespace {

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
