#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "host/formats/tables/row_times.hpp"
#include "host/formats/tables/rows.hpp"
#include "host/truth/files/body_track.hpp"
#include "host/truth/files/track_problem.hpp"

/// Converts the cells of a row to a pose: which column holds what, in which unit.
namespace astro::truth {

/// What a column can hold. The first three are kept as text, the others are numbers.
enum class Slot : std::uint8_t { frame, time, time_fraction, x, y, z, rx, ry, rz, rw, heading, roll, pitch };
inline constexpr std::size_t kSlots = 13, kTextSlots = 3;

struct PoseColumns {
  /// The column of each slot, from 0; -1 if the table has none.
  std::array<int, kSlots> column;
  tables::NumberStyle style;
  RotationKind rotation = RotationKind::none;
  std::string_view euler_order = "XYZ";
  double metres = 1;   // of the file's unit of length
  double radians = 1;  // of the file's unit of angle

  PoseColumns() { column.fill(-1); }
  int& operator[](Slot slot) { return column[static_cast<std::size_t>(slot)]; }
  int operator[](Slot slot) const { return column[static_cast<std::size_t>(slot)]; }
};

/// Reads rows by a fixed assignment of columns. Cells behind the last one that is needed are not looked at.
class PoseRow {
 public:
  explicit PoseRow(const PoseColumns& columns);

  /// Takes the cells of the current row. A missing or empty cell is no error.
  /// Throws astro::Error with file, line and column if a cell that must be a number is none.
  void read(const tables::Rows& rows);

  std::string_view frame() const { return text_[0]; }
  std::string_view time() const { return text_[1]; }
  std::string_view time_fraction() const { return text_[2]; }

  /// The pose in SI units with a quaternion of length 1, or an invalid one if a cell is empty or no body can
  /// have this pose (zeros for a lost body). A rotation vector stays as it is in qx, qy and qz, with qw = 0,
  /// because only the whole recording shows whether the file means Euler angles instead.
  TrackedPose pose() const;

 private:
  double at(Slot slot) const { return number_[static_cast<std::size_t>(slot)]; }
  bool complete() const { return (present_ & needed_) == needed_; }

  PoseColumns columns_;
  std::vector<std::uint8_t> slot_of_;  // for each column up to the last needed one; kSlots: not needed
  std::array<std::string_view, kTextSlots> text_;
  std::array<double, kSlots> number_{};
  std::uint32_t present_ = 0, needed_ = 0;
};

/// Collects samples, and limits the memory that a hostile file can take.
class TrackBuilder {
 public:
  TrackBuilder(BodyTrack& track, std::string_view text);

  /// A sample whose time follows from its number. Throws astro::Error with file and line if the time falls, or if
  /// there are more samples than can be held.
  void add(const TrackedPose& sample, const tables::Rows& rows);

  /// A sample with a stamp, whose faults finish() mends. Throws only for too many samples.
  void add_stamped(const TrackedPose& sample, const tables::Rows& rows);
  /// Mends the times (host/formats/tables/row_times.hpp), and leaves out samples that repeat one. A remark says what was done.
  /// Throws astro::Error with file and line for times that fall otherwise, and naming `file` if many times repeat, and not evenly.
  void finish(std::string_view file);

 private:
  BodyTrack& track_;
  std::size_t most_;
  tables::RowTimes row_times_;
};

}  // namespace astro::truth
