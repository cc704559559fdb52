#pragma once

#include <array>
#include <cmath>

/// The operations on vectors and matrices over a pose (x, y, theta) that the filter needs, written out.
///
/// The filter spends its time on matrices of three rows, of which half the entries are known beforehand: they are symmetric,
/// or the identity but for two entries. Eigen's general products compute these entries, too, and take three times as long.
namespace astro::calibration {

/// Two numbers that are computed side by side, in the time of one. The entries of matrices may be of this kind.
using Pair = double __attribute__((vector_size(2 * sizeof(double))));

template <class Number>
using VectorOf = std::array<Number, 3>;
template <class Number>
using MatrixOf = std::array<VectorOf<Number>, 3>;  // rows
using Vector3 = VectorOf<double>;
using Matrix3 = MatrixOf<double>;

template <class Number>
struct SymmetricOf {
  Number xx{}, xy{}, xt{}, yy{}, yt{}, tt{};

  SymmetricOf& operator+=(const SymmetricOf& other) {
    xx += other.xx, xy += other.xy, xt += other.xt;
    yy += other.yy, yt += other.yt, tt += other.tt;
    return *this;
  }
  SymmetricOf& operator*=(double factor) {
    xx *= factor, xy *= factor, xt *= factor;
    yy *= factor, yt *= factor, tt *= factor;
    return *this;
  }
  MatrixOf<Number> full() const { return {{{xx, xy, xt}, {xy, yy, yt}, {xt, yt, tt}}}; }
};

using Symmetric3 = SymmetricOf<double>;

inline Symmetric3 operator+(Symmetric3 a, const Symmetric3& b) { return a += b; }
inline Symmetric3 operator*(double factor, Symmetric3 a) { return a *= factor; }

template <class A, class B>
auto dot(const VectorOf<A>& a, const VectorOf<B>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

template <class A, class B>
VectorOf<decltype(A() * B())> product(const SymmetricOf<A>& a, const VectorOf<B>& v) {
  return {a.xx * v[0] + a.xy * v[1] + a.xt * v[2], a.xy * v[0] + a.yy * v[1] + a.yt * v[2],
          a.xt * v[0] + a.yt * v[1] + a.tt * v[2]};
}

template <class B>
VectorOf<B> product(const Matrix3& a, const VectorOf<B>& v) {
  return {dot(a[0], v), dot(a[1], v), dot(a[2], v)};
}

template <class B>
MatrixOf<B> product(const Matrix3& a, const SymmetricOf<B>& b) {
  // A row of the product is b times the row, because b is symmetric.
  return {product(b, a[0]), product(b, a[1]), product(b, a[2])};
}

/// a b' where that is known to be symmetric.
template <class A>
SymmetricOf<A> symmetric_product(const MatrixOf<A>& a, const Matrix3& b) {
  return {dot(a[0], b[0]), dot(a[0], b[1]), dot(a[0], b[2]),
          dot(a[1], b[1]), dot(a[1], b[2]), dot(a[2], b[2])};
}

/// Sum of the products of all entries: the trace of a b.
inline double trace_of_product(const Symmetric3& a, const Symmetric3& b) {
  return a.xx * b.xx + a.yy * b.yy + a.tt * b.tt + 2 * (a.xy * b.xy + a.xt * b.xt + a.yt * b.yt);
}

/// F p F' with F = (1 0 x; 0 1 y; 0 0 1). An error of the heading moves a point at (a, b) from the robot's centre by (-b, a)
/// for each radian. So with (x, y) = (-b, a) this is the covariance of that point's position and the heading, if p is that of
/// the robot's centre and the heading.
template <class Number>
SymmetricOf<Number> sheared(const SymmetricOf<Number>& p, double x, double y) {
  const Number xt = p.xt + x * p.tt, yt = p.yt + y * p.tt;
  return {p.xx + x * (p.xt + xt), p.xy + x * p.yt + y * xt, xt, p.yy + y * (p.yt + yt), yt, p.tt};
}

/// p F' with the same F.
inline Matrix3 times_shear(const Symmetric3& p, double x, double y) {
  return {{{p.xx + x * p.xt, p.xy + y * p.xt, p.xt},
           {p.xy + x * p.yt, p.yy + y * p.yt, p.yt},
           {p.xt + x * p.tt, p.yt + y * p.tt, p.tt}}};
}

/// R p R' with R = (c -s 0; s c 0; 0 0 1): the covariance p of a pose in the robot's axes, given in axes in which the robot
/// has the heading of this cosine and sine.
inline Symmetric3 rotated(const Symmetric3& p, double c, double s) {
  return {c * c * p.xx - 2 * c * s * p.xy + s * s * p.yy,
          c * s * (p.xx - p.yy) + (c * c - s * s) * p.xy,
          c * p.xt - s * p.yt,
          s * s * p.xx + 2 * c * s * p.xy + c * c * p.yy,
          s * p.xt + c * p.yt,
          p.tt};
}

inline double determinant(const Symmetric3& a) {
  return a.xx * (a.yy * a.tt - a.yt * a.yt) - a.xy * (a.xy * a.tt - a.xt * a.yt) +
         a.xt * (a.xy * a.yt - a.xt * a.yy);
}

inline Symmetric3 inverse(const Symmetric3& a) {
  const double xx = a.yy * a.tt - a.yt * a.yt, xy = a.xt * a.yt - a.xy * a.tt, xt = a.xy * a.yt - a.xt * a.yy;
  const double scale = 1 / (a.xx * xx + a.xy * xy + a.xt * xt);
  return {scale * xx,
          scale * xy,
          scale * xt,
          scale * (a.xx * a.tt - a.xt * a.xt),
          scale * (a.xy * a.xt - a.xx * a.yt),
          scale * (a.xx * a.yy - a.xy * a.xy)};
}

/// v divided by the Cholesky factor of `covariance`: its components are independent and of variance 1.
inline Vector3 standardised(const Vector3& v, const Symmetric3& covariance) {
  const double lx = std::sqrt(covariance.xx), lxy = covariance.xy / lx, lxt = covariance.xt / lx;
  const double ly = std::sqrt(covariance.yy - lxy * lxy), lyt = (covariance.yt - lxy * lxt) / ly;
  const double lt = std::sqrt(covariance.tt - lxt * lxt - lyt * lyt);
  const double x = v[0] / lx, y = (v[1] - lxy * x) / ly;
  return {x, y, (v[2] - lxt * x - lyt * y) / lt};
}

}  // namespace astro::calibration
