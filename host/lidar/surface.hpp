#pragma once

#include <span>
#include <vector>

#include "host/base/pose2.hpp"
#include "host/lidar/scan.hpp"

/// What a scan shows of the walls around it: points, and where they lie on a line, the line's normal.
namespace astro::lidar {

struct SurfacePoint {
  Point2 at;
  Point2 normal;         // of length 1, of either sign
  bool on_line = false;  // the neighbours lie on a line, so that the normal means something
};

/// The points of a scan, in the scanner's frame at the moment of the first beam and in the order of the beams. Readings outside
/// of the scan's limits are left out. A normal is that of the points within about 12 cm, at least three on each side, so that it
/// does not get noisier the denser the beams are.
///
/// way: the scanner's motions in its own frame, each over an equal part of the time that the scan takes (a spinning scanner takes 0.1
/// to 0.2 s for a turn, in which the robot drives on). The beams are put where they were measured from. Empty: it stood still.
std::vector<SurfacePoint> surface_of(const Scan& scan, std::span<const Twist2> way);

/// The same scan of a scanner whose beams run the other way round, or that hangs upside down.
Scan mirrored(Scan scan);

}  // namespace astro::lidar
