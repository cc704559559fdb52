#pragma once

#include <array>
#include <span>
#include <vector>

#include "host/calibration/end_poses/end_pose.hpp"

/// Tables 11-16 of the thesis: end-pose errors (absolute - odometry) of the real robot on a 3 m square, five
/// runs per direction, before calibration, after UMBmark and after extended UMBmark.
namespace astro::golden {

inline constexpr double kSide_m = 3.0;
inline constexpr double kNominalWheelbase_m = 0.290;

struct Printed {
  double x_mm, y_mm, theta_rad;
};
using Table = std::array<Printed, 5>;

inline constexpr Table kTable11Cw{{{-271.98, -385.85, 0.1874},
                                   {-189.93, -156.64, 0.1222},
                                   {-163.22, -173.55, 0.1206},
                                   {-186.73, -232.51, 0.1439},
                                   {-304.81, -351.47, 0.1821}}};
inline constexpr Table kTable12Ccw{{{296.89, -229.72, 0.1603},
                                    {283.94, -229.84, 0.1782},
                                    {412.08, -311.36, 0.2058},
                                    {319.38, -274.06, 0.1842},
                                    {257.95, -233.58, 0.1448}}};
inline constexpr Table kTable13CwUmbmark{{{-1.94, -8.12, 0.0047},
                                          {-30.37, -52.88, 0.0101},
                                          {-19.58, 9.44, -0.0036},
                                          {-17.7, 2.57, 0.0094},
                                          {-128.89, -46.97, 0.0478}}};
inline constexpr Table kTable14CcwUmbmark{{{-80.88, 51.13, 0.0523},
                                           {-17.34, 42.01, 0.0076},
                                           {-102.11, 54.15, 0.066},
                                           {-70.35, 104.66, 0.0471},
                                           {-63.89, 48.67, 0.0343}}};
inline constexpr Table kTable15CwExtended{{{-65.49, -89.0, 0.0441},
                                           {-99.01, -69.33, 0.0442},
                                           {95.39, 68.58, -0.0373},
                                           {87.79, 71.94, -0.0403},
                                           {113.73, 70.33, -0.023}}};
inline constexpr Table kTable16CcwExtended{{{0.43, -23.53, 0.0036},
                                            {-41.08, -4.92, -0.0226},
                                            {6.22, -78.73, 0.0196},
                                            {68.49, -66.28, 0.0239},
                                            {-93.73, -4.02, -0.0283}}};

inline std::vector<calibration::EndPose> end_poses(std::span<const Printed> table) {
  std::vector<calibration::EndPose> out;
  for (const Printed& row : table) out.push_back({row.x_mm / 1000, row.y_mm / 1000, row.theta_rad});
  return out;
}

}  // namespace astro::golden
