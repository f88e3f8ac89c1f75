// SPDX-License-Identifier: Apache-2.0
// One direction of the tread's smooth surface (tread_surface.h): Hermite's cubics between its nodes
// and their means over hats.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace latsch::fe_tire {

/// Means a face, around and across.
constexpr int kPlaces = 4;

/// Weights of four neighbors, the second and third being the ends of a face, and their derivatives
/// by u in [-1, 1].
struct Cubic {
  Eigen::Vector4d value, slope;
};

/// Of a face of length h; h0 and h2 are those of its neighbors, none where the surface ends.
Cubic hermite(std::optional<double> h0, double h, std::optional<double> h2, double u);
Cubic linear(double u);

/// (T.3) of the node between the second and the third of four faces beside each other, those that
/// are there, by their lengths.
double share_of_uniform(const std::array<std::optional<double>, 4>& h);

/// Of a place, counted in kPlaces a face; that at a node belongs to the face behind it.
inline int face_of(int place) {
  return place >= 0 ? place / kPlaces : -((kPlaces - 1 - place) / kPlaces);
}

/// On [-1, 1] of that face.
inline double within_face(int place) {
  return 2.0 * (place - kPlaces * face_of(place)) / kPlaces - 1.0;
}

/// Integrals over the hat N that is 1 at a place and 0 a face before and behind it, in one
/// direction of the surface.
struct HatMean {
  int first = 0;  // node of the first weight
  std::array<double, 6> weight{};
  double size = 0.0;
};

/// `cubic` and `measure` (per u) of a face at u. Where there are ends, nothing is before node 0 nor
/// behind the `last` one: what hats of places beyond them would have, those of their images take.
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
