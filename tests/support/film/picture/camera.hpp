#pragma once

#include <Eigen/Core>

#include <vector>

/// Where a camera stands. World: z up, metres, the floor is z = 0. Camera: x right, y down, z forward.
namespace astro::support::film {

/// How a phone's lens forms a picture, written down once more and apart from any estimator.
///
///   r2 = x^2 + y^2,  (x, y, 1) a direction in the camera: x right, y down
///   s  = 1 + k1 r2 + k2 r2^2 + k3 r2^3
///   u  = cx + f (s x + 2 p1 x y + p2 (r2 + 2 x^2))
///   v  = cy + f (s y + p1 (r2 + 2 y^2) + 2 p2 x y)
///
/// Units   pixels; (0, 0) is the centre of the upper left pixel
/// Source  D. C. Brown, Decentering distortion of lenses, 1966; order of the coefficients as in OpenCV
struct Lens {
  int width_px = 1920, height_px = 1080;
  double f_px = 1500, cx_px = 959.5, cy_px = 539.5;
  double k1 = 0, k2 = 0, p1 = 0, p2 = 0, k3 = 0;
};

struct Pixel {
  double u = 0, v = 0;
};

struct Ray {
  double x = 0, y = 0;
};

Pixel seen_at(const Lens& lens, Ray ray);

/// The inverse, to 1e-7 pixels. Precondition: the lens does not fold the picture over itself there.
Ray ray_of(const Lens& lens, Pixel pixel);

/// The rays of all pixels.
class RayTable {
 public:
  explicit RayTable(const Lens& lens);

  struct Local {
    float x, y;                        // at the pixel's centre
    float dx_du, dx_dv, dy_du, dy_dv;  // per pixel
  };
  Local at(int u, int v) const;
  float x(int u, int v) const { return x_[index(u, v)]; }
  float y(int u, int v) const { return y_[index(u, v)]; }

 private:
  std::size_t index(int u, int v) const {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(u);
  }
  int width_, height_;
  std::vector<float> x_, y_;
};

struct Camera {
  Eigen::Vector3d position_m = Eigen::Vector3d(0, 0, 2);
  Eigen::Matrix3d world_to_camera = Eigen::Matrix3d::Identity();
};

/// Looks from a place at another; the top of the picture is on the side of the world's +y. `roll_rad` turns the camera about its
/// axis, clockwise as it looks. Precondition: it does not look along +-y.
Camera looking_at(const Eigen::Vector3d& position_m, const Eigen::Vector3d& target_m, double roll_rad = 0);

/// The same camera, turned in its own frame: about its x axis (positive: the picture moves down, the camera looks up), its y axis
/// (positive: the picture moves left) and its z axis.
Camera turned(const Camera& camera, double about_x_rad, double about_y_rad, double about_z_rad = 0);

/// Precondition: the point is before the camera.
Pixel seen_at(const Lens& lens, const Camera& camera, const Eigen::Vector3d& point_m);

/// When rows are exposed. The middle of row v's exposure is v / rows * readout_s after that of row 0; a negative readout reads
/// from the bottom row to the top one.
struct Shutter {
  double readout_s = 0.020, exposure_s = 0.008;

  double row_s(double first_row_s, double row, int rows) const {
    return first_row_s + row / rows * readout_s;
  }
};

/// One exposure: camera, lens and shutter, and when its first row was exposed, by the robot's clock.
struct Exposure {
  const Lens* lens;
  const RayTable* rays;
  Camera camera;
  Shutter shutter;
  double first_row_s;
};

}  // namespace astro::support::film
