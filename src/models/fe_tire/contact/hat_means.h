// SPDX-License-Identifier: Apache-2.0
// The tread's smooth surface (tread_surface.h) in one direction, circumferential or across: cubic
// Hermite interpolation between nodes, and integrals of it weighted by hat functions.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace latsch::fe_tire {

/// Number of averaged points per face, in each direction.
constexpr int kPlaces = 4;

/// Weights of four neighboring nodes in the interpolation, and the weights' derivatives with
/// respect to u in [-1, 1]. The second and third node are the ends of the face.
struct Cubic {
  Eigen::Vector4d value, slope;
};

/// Returns the weights of the Hermite cubic at u in a face of length h. h0 and h2 are the lengths
/// of the neighboring faces; not set where the surface ends.
Cubic hermite(std::optional<double> h0, double h, std::optional<double> h2, double u);
Cubic linear(double u);

/// Returns the factor of equation (T.3) for the node between the second and third of four adjacent
/// faces, from the lengths of those that exist.
double share_of_uniform(const std::array<std::optional<double>, 4>& h);

/// Returns the face that contains a point. Points are numbered along the surface, kPlaces per face.
/// A point at a node belongs to the face after it.
inline int face_of(int place) {
  return place >= 0 ? place / kPlaces : -((kPlaces - 1 - place) / kPlaces);
}

/// Returns the coordinate in [-1, 1] of a point within its face.
inline double within_face(int place) {
  return 2.0 * (place - kPlaces * face_of(place)) / kPlaces - 1.0;
}

/// Weights of an integral with the hat function N in one direction of the surface. N is 1 at a
/// point and falls to 0 at a distance of one face on both sides.
struct HatMean {
  int first = 0;  // index of the node to which the first weight belongs
  std::array<double, 6> weight{};
  double size = 0.0;
};

/// Integrates with the hat function centered at `place`. `cubic_at` returns the interpolation and
/// `measure_at` the length per u of a face at u. If `last` is given, the surface ends at node 0 and
/// at node `last`; the parts of hat functions beyond these ends are reflected inward.
template <class CubicAt, class MeasureAt>
HatMean hat_mean(int place, std::optional<int> last, CubicAt cubic_at, MeasureAt measure_at) {
  const auto hat = [](double at, int center) {
    return std::max(0.0, 1.0 - std::abs(at - static_cast<double>(center) / kPlaces));
  };
  // Abscissae and weights of three Gauss points on [-1, 1].
  constexpr double kThree[3] = {-0.77459666924148337704, 0.0, 0.77459666924148337704};
  constexpr double kThreeWeight[3] = {5.0 / 9.0, 8.0 / 9.0, 5.0 / 9.0};
  HatMean mean;
  mean.first = face_of(place - kPlaces) - 1;
  for (int part = place - kPlaces; part < place + kPlaces; ++part) {
    const int face = face_of(part);
    if (last && (face < 0 || face >= *last)) continue;
    for (int q = 0; q < 3; ++q) {
      const double t = (part - kPlaces * face + 0.5 * (1.0 + kThree[q])) / kPlaces;
      double N = hat(face + t, place);
      if (last && place > 0) N += hat(face + t, -place);
      if (last && place < kPlaces * *last) N += hat(face + t, 2 * kPlaces * *last - place);
      const Cubic cubic = cubic_at(face, 2.0 * t - 1.0);
      const double d = kThreeWeight[q] / kPlaces * N * measure_at(face, t, cubic);
      mean.size += d;
      for (int k = 0; k < 4; ++k) mean.weight[face - 1 + k - mean.first] += d * cubic.value[k];
    }
  }
  return mean;
}

}  // namespace latsch::fe_tire
