#include "host/truth/files/frame_numbers.hpp"

#include <cmath>

#include "host/truth/files/track_problem.hpp"

namespace astro::truth {

std::int64_t FrameNumbers::take(std::string_view cell, const tables::Rows& rows) {
  constexpr double kMostFrames = 1e12;
  const auto number = tables::cell_number(cell, separator_);
  if (!number || *number != std::floor(*number) || std::abs(*number) > kMostFrames)
    rows.refuse(1, tables::shown_cell(cell) + " is no frame number", TrackProblem::no_frame_number,
                {tables::cut_cell(cell)});
  const auto frame = static_cast<std::int64_t>(*number);
  if (last_ && frame > *last_) dropped_ += frame - *last_ - 1;
  last_ = frame;
  return frame;
}

std::int64_t frame_time_ns(std::int64_t frame, double rate_hz, const tables::Rows& rows) {
  const double time_s = static_cast<double>(frame) / rate_hz;
  if (!(std::abs(time_s) < 2e9)) rows.refuse(1, "the frame number is too large for a recording");
  return std::llround(time_s * 1e9);
}

}  // namespace astro::truth
