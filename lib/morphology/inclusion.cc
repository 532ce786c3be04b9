#include "morphology/inclusion.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace mesoslip
{
namespace
{
/** Square of the distance (m^2) in the plane across axis @p along. */
double square_across(const Vector3 &d, const unsigned int along)
{
  double sum = 0.;
  for (unsigned int c = 0; c < 3; ++c)
    sum += c == along ? 0. : d[c] * d[c];
  return sum;
}

bool are_along_the_axes(const Inclusion &inclusion)
{
  for (unsigned int k = 0; k < 3; ++k)
    if (inclusion.axes[k][k] != 1.)
      return false;
  return true;
}

/** Shape matrix of an ellipsoid: sum of half^2 times the dyads of its axes. */
Eigen::Matrix3d extents_matrix(const Inclusion &inclusion)
{
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (unsigned int k = 0; k < 3; ++k)
    {
      const Eigen::Vector3d axis(inclusion.axes[k].data());
      sum += inclusion.half[k] * inclusion.half[k] * axis * axis.transpose();
    }
  return sum;
}

/** Overlap of two homothetic ellipsoids with axes along the coordinate axes. */
bool homothetic_overlap(const Inclusion &a, const Inclusion &b, const Vector3 &d)
{
  double square = 0.;
  for (unsigned int k = 0; k < 3; ++k)
    square += std::pow(d[k] / (a.half[k] + b.half[k]), 2);
  return square < 1.;
}

/**
 * The largest value of l (1 - l) r^T [(1 - l) A + l B]^-1 r in 0 < l < 1 is the square of
 * the factor by which both may grow before they touch. It is concave in l.
 */
bool ellipsoids_overlap(const Inclusion &a, const Inclusion &b, const Vector3 &d)
{
  const Eigen::Matrix3d A = extents_matrix(a), B = extents_matrix(b);
  const Eigen::Vector3d r(d.data());
  const auto value = [&](const double l) {
    const Eigen::Matrix3d C = (1. - l) * A + l * B;
    return l * (1. - l) * r.dot(C.inverse() * r);
  };
  constexpr double golden = 0.6180339887498949;
  double low = 0., high = 1., left = 1. - golden, right = golden;
  double at_left = value(left), at_right = value(right);
  for (unsigned int step = 0; step < 60 && high - low > 1e-9; ++step)
    {
      if (at_left >= 1. || at_right >= 1.)
        return false;
      if (at_left < at_right)
        {
          low      = left;
          left     = right;
          at_left  = at_right;
          right    = low + golden * (high - low);
          at_right = value(right);
        }
      else
        {
          high     = right;
          right    = left;
          at_right = at_left;
          left     = high - golden * (high - low);
          at_left  = value(left);
        }
    }
  return true;
}
} // namespace

Vector3 Inclusion::reach() const
{
  if (shape != InclusionShape::ellipsoid)
    return half;
  Vector3 result = {};
  for (unsigned int c = 0; c < 3; ++c)
    {
      for (unsigned int k = 0; k < 3; ++k)
        result[c] += std::pow(half[k] * axes[k][c], 2);
      result[c] = std::sqrt(result[c]);
    }
  return result;
}

bool Inclusion::contains(const Vector3 &d) const
{
  const auto between = [&](const unsigned int c) {
    return (through && c == along) || (d[c] >= -half[c] && d[c] < half[c]);
  };
  switch (shape)
    {
    case InclusionShape::sphere:
      return d[0] * d[0] + d[1] * d[1] + d[2] * d[2] < half[0] * half[0];
    case InclusionShape::ellipsoid:
      {
        double square = 0.;
        for (unsigned int k = 0; k < 3; ++k)
          {
            const double x =
              (axes[k][0] * d[0] + axes[k][1] * d[1] + axes[k][2] * d[2]) / half[k];
            square += x * x;
          }
        return square < 1.;
      }
    case InclusionShape::cylinder:
      {
        const double radius = half[(along + 1) % 3];
        return between(along) && square_across(d, along) < radius * radius;
      }
    default:
      return between(0) && between(1) && between(2);
    }
}

double Inclusion::volume() const
{
  const double box = 8. * half[0] * half[1] * half[2];
  return shape == InclusionShape::bar        ? box
         : shape == InclusionShape::cylinder ? box * M_PI / 4.
                                             : box * M_PI / 6.;
}

bool too_close(const Inclusion &a, const Inclusion &b, const Vector3 &d, const double gap)
{
  const auto near = [&](const unsigned int c) {
    return (a.through && c == a.along) || std::fabs(d[c]) < a.half[c] + b.half[c] + gap;
  };
  const unsigned int across = (a.along + 1) % 3;
  const double distance     = a.half[across] + b.half[across] + gap;
  switch (a.shape)
    {
    case InclusionShape::sphere:
      return d[0] * d[0] + d[1] * d[1] + d[2] * d[2] < distance * distance;
    case InclusionShape::cylinder:
      return near(a.along) && square_across(d, a.along) < distance * distance;
    case InclusionShape::bar:
      return near(0) && near(1) && near(2);
    default:
      return are_along_the_axes(a) && are_along_the_axes(b) ? homothetic_overlap(a, b, d)
                                                            : ellipsoids_overlap(a, b, d);
    }
}
} // namespace mesoslip
