#pragma once

#include <complex>
#include <optional>

#include "host/formats/tables/table.hpp"
#include "host/truth/files/pose_columns.hpp"

/// Whether the headings of a table count in degrees or radians, and which way round, as the directions of its motion show.
namespace astro::truth {

/// How well the direction of motion follows the heading if its unit has so many radians: 1 if they differ by a constant, 0 if
/// they have nothing in common.
class DirectionMatch {
 public:
  explicit DirectionMatch(double radians) : radians_(radians) {}

  void take(double direction_rad, double heading);
  /// Of a robot that may drive backwards, in a table that may be a mirror image.
  double share() const;
  /// Of one that drives one way. On a square, driven either way, both senses fit.
  double forward_share(bool clockwise) const;

 private:
  double radians_;
  std::complex<double> forward_[2], either_way_[2];  // by sense: counter-clockwise, clockwise
  int count_ = 0;
};

/// How well the headings of a table match the directions of its motion, by their unit. Leaves the table before its first row.
class HeadingMatch {
 public:
  HeadingMatch(tables::Table& table, const PoseColumns& columns, Slot heading);

  bool are_degrees() const;
  const DirectionMatch& in(bool degrees) const { return degrees ? in_degrees_ : in_radians_; }

 private:
  double extent(tables::Table& table, const PoseColumns& columns, Slot heading);

  DirectionMatch in_radians_, in_degrees_;
  double most_angle_ = 0;
};

}  // namespace astro::truth
