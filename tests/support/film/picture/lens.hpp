#pragma once

#include <vector>

/// How a phone's lens forms a picture, written down once more and apart from any estimator.
///
///   r2 = x^2 + y^2,  (x, y, 1) a direction in the camera: x right, y down
///   s  = 1 + k1 r2 + k2 r2^2 + k3 r2^3
///   u  = cx + f (s x + 2 p1 x y + p2 (r2 + 2 x^2))
///   v  = cy + f (s y + p1 (r2 + 2 y^2) + 2 p2 x y)
///
/// Units   pixels; (0, 0) is the centre of the upper left pixel
/// Source  D. C. Brown, Decentering distortion of lenses, 1966; order of the coefficients as in OpenCV
namespace astro::support::film {

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

}  // namespace astro::support::film
