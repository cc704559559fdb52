#pragma once

#include <array>

namespace astro::film::paper {

/// Number of tags in the family tag36h11; ids run from 0.
inline constexpr int kTagCount = 587;

/// The black square of a tag: eight cells a side, of which the outer ring is black. Around it belongs a white margin of one
/// cell at least.
inline constexpr int kCells = 8;

/// A tag as it stands upright; row 0 is its top, column 0 its left side.
class TagPicture {
 public:
  bool white(int row, int column) const { return white_[index(row, column)]; }
  void set_white(int row, int column) { white_[index(row, column)] = true; }

 private:
  static std::size_t index(int row, int column) { return static_cast<std::size_t>(row * kCells + column); }

  std::array<bool, static_cast<std::size_t>(kCells* kCells)> white_{};
};

/// The official picture of tag36h11 number `id`. Throws astro::Error if there is none of that number.
/// Source  E. Olson's codes in libapriltag (tag36h11_create).
TagPicture tag_picture(int id);

}  // namespace astro::film::paper
