#pragma once

#include <array>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "host/formats/tables/rows.hpp"
#include "host/truth/files/body_choice.hpp"
#include "host/truth/files/pose_columns.hpp"
#include "host/truth/files/track_problem.hpp"

/// The head of a Motive table: what motive_csv.hpp needs to read its rows.
namespace astro::truth {

struct MotiveBody {
  BodyName name;
  std::array<int, 3> position{-1, -1, -1};
  std::array<int, 4> rotation{-1, -1, -1, -1};  // x, y, z, w; no w for Euler angles
};

struct MotiveHeader {
  char separator = ',';
  std::map<std::string, std::string, std::less<>> values;  // of the first line
  std::vector<MotiveBody> bodies;
  int frame_column = 0, time_column = -1, time_code_column = -1;

  std::string value(std::string_view key) const;  // "" if there is none
  double number(std::string_view key) const;      // 0 if there is none
};

/// Reads up to and with the row that begins with Frame. Throws astro::Error if the header is missing, or if
/// there is no rigid body.
MotiveHeader read_motive_header(tables::Rows& rows);

}  // namespace astro::truth
