#include "tests/support/film/film.hpp"

#include <cmath>

namespace astro::support::film {

TrueFrame true_frame(const FilmSetup& setup, const FrameTime& time) {
  const FilmedRobot& robot = setup.scene.robots.front();
  const Camera camera = setup.camera(time.pts_s);
  TrueFrame frame{time, robot.tag_at(time.robot_s), 0, time.robot_s, {}};
  for (int round = 0; round < 5;
       ++round) {  // the tag moves by less than a row in a row's time: converges at once
    frame.at_row = robot.tag_at(frame.row_s);
    frame.row = seen_at(setup.lens, camera, {frame.at_row.x_m, frame.at_row.y_m, robot.height_m}).v;
    frame.row_s = setup.shutter.row_s(time.robot_s, frame.row, setup.lens.height_px);
  }
  return frame;
}

std::vector<TrueFrame> make_film(const FilmSetup& setup, const std::filesystem::path& mp4) {
  Renderer renderer(setup.scene, setup.lens, setup.blur_px, setup.sensor, setup.seed);
  Encoder encoder(mp4, setup.lens.width_px, setup.lens.height_px, setup.clock.fps, setup.codec);
  std::vector<std::uint8_t> picture(static_cast<std::size_t>(setup.lens.width_px) *
                                    static_cast<std::size_t>(setup.lens.height_px));
  std::vector<TrueFrame> truth;
  for (const FrameTime& time : frame_times(setup.clock, setup.begin_s, setup.end_s, setup.cut)) {
    renderer.render(setup.camera(time.pts_s), setup.shutter, time.robot_s, picture.data());
    encoder.add(time.pts_s, picture);
    truth.push_back(true_frame(setup, time));
  }
  encoder.finish();
  return truth;
}

}  // namespace astro::support::film
