#pragma once

#include <optional>
#include <vector>

namespace astro::film {

/// What a person states about the printed tags. A size that is not given is assumed as the sheets are
/// printed. The scale counts as measured only if a side or a tape is given.
struct FilmFigures {
  int robot_id = 0;
  std::optional<double> robot_side_m, floor_side_m;  // of the black squares
  std::optional<double> robot_height_m;              // of the robot's tag above the floor
  struct Length {
    int from = 0, to = 0;  // ids of floor tags
    double length_m = 0;   // from centre to centre
  };
  std::vector<Length> tapes;
  /// True: a figure that is not given has a prior, the printed size of the sheets or a height of 0.12 m.
  /// False: the priors are so wide that they have no effect.
  bool as_usual = true;
  double readout_s = 0.02;  // from the first row to the last; negative if the last row is read first

  /// Whether a distance that fixes the scale is given. The height of a tag alone does not fix it.
  bool scale_measured() const { return robot_side_m || floor_side_m || !tapes.empty(); }
};

}  // namespace astro::film
