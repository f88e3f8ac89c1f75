// SPDX-License-Identifier: Apache-2.0
#include "formats/mesh/hexahedron.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cassert>
#include <limits>

namespace latsch::formats {
namespace {

constexpr int kSign[8][3] = {{-1, -1, -1},
                             {1, -1, -1},
                             {1, 1, -1},
                             {-1, 1, -1},
                             {-1, -1, 1},
                             {1, -1, 1},
                             {1, 1, 1},
                             {-1, 1, 1}};

Eigen::Vector3i unit(LocalDirection d) { return d.sign * Eigen::Vector3i::Unit(d.axis); }

int corner_at(const Eigen::Vector3i& sign) {
  for (int a = 0; a < 8; ++a)
    if (sign == Eigen::Vector3i(kSign[a][0], kSign[a][1], kSign[a][2])) return a;
  assert(false);
  return -1;
}

}  // namespace

LocalDirection face_direction(int face) {
  static constexpr LocalDirection kOutward[6] = {{2, -1}, {2, 1}, {1, -1}, {0, 1}, {1, 1}, {0, -1}};
  assert(1 <= face && face <= 6);
  return kOutward[face - 1];
}

std::array<int, 4> face_corners(LocalDirection outward) {
  std::array<int, 4> corners{};
  int count = 0;
  for (int a = 0; a < 8; ++a)
    if (kSign[a][outward.axis] == outward.sign) corners[count++] = a;
  return corners;
}

Eigen::Vector3d span(const Hex& X, LocalDirection direction) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int a = 0; a < 8; ++a) sum += direction.sign * kSign[a][direction.axis] * X.col(a);
  return 0.25 * sum;
}

double smallest_corner_volume(const Hex& X) {
  double least = std::numeric_limits<double>::infinity();
  for (int a = 0; a < 8; ++a) {
    Eigen::Matrix3d edges;
    for (int axis = 0; axis < 3; ++axis) {
      Eigen::Vector3i other(kSign[a][0], kSign[a][1], kSign[a][2]);
      other[axis] = -other[axis];
      edges.col(axis) = -kSign[a][axis] * (X.col(corner_at(other)) - X.col(a));
    }
    least = std::min(least, edges.determinant());
  }
  return least;
}

std::array<int, 8> renumbering(LocalDirection xi, LocalDirection zeta) {
  assert(xi.axis != zeta.axis);
  const Eigen::Vector3i x = unit(xi), z = unit(zeta);
  const Eigen::Vector3i y = z.cross(x);
  std::array<int, 8> present{};
  for (int a = 0; a < 8; ++a)
    present[a] = corner_at(kSign[a][0] * x + kSign[a][1] * y + kSign[a][2] * z);
  return present;
}

}  // namespace latsch::formats
