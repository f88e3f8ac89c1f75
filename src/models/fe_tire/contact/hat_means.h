// SPDX-License-Identifier: Apache-2.0
// One direction of the tread's smooth surface (tread_surface.h): cubic Hermite interpolation
// between its nodes, and means of it over hat functions.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace latsch::fe_tire {

/// Number of means a face, in each direction.
constexpr int kPlaces = 4;

/// Weights of four neighbors, of which the second and third are the ends of a face, and their
/// derivatives with respect to u in [-1, 1].
struct Cubic {
  Eigen::Vector4d value, slope;
};

/// Hermite cubic of a face of length h. h0 and h2 are the lengths of its neighbors, none where the
/// surface ends.
Cubic hermite(std::optional<double> h0, double h, std::optional<double> h2, double u);
Cubic linear(double u);

/// Returns (T.3) of the node between the second and the third of four adjacent faces, given the
/// lengths of those that exist.
double share_of_uniform(const std::array<std::optional<double>, 4>& h);

/// Returns the face that contains a place; each face has kPlaces of them. A place at a node belongs
/// to the face behind it.
inline int face_of(int place) {
  return place >= 0 ? place / kPlaces : -((kPlaces - 1 - place) / kPlaces);
}

/// Returns the place's coordinate in [-1, 1] of that face.
inline double within_face(int place) {
  return 2.0 * (place - kPlaces * face_of(place)) / kPlaces - 1.0;
}

/// Integrals over the hat function N in one direction of the surface. N is 1 at a place and 0 a
/// face before and behind it.
struct HatMean {
  int first = 0;  // node of the first weight
  std::array<double, 6> weight{};
  double size = 0.0;
};

/// Integrates over the hat at `place`. `cubic_at` and `measure_at` (per u) evaluate a face at u. If
/// `last` is given, the surface ends at node 0 and at node `last`: the parts of hats beyond these
/// ends are mirrored to the inside.
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
