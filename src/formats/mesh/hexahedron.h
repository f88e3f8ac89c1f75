// SPDX-License-Identifier: Apache-2.0
// Faces and local axes of an eight-node element in the numbering of CalculiX and Abaqus.
#pragma once

#include <Eigen/Core>
#include <array>

namespace latsch::formats {

using HexNodes = std::array<int, 8>;
using Hex = Eigen::Matrix<double, 3, 8>;

/// Positions of the stress components 11 22 33 12 13 23 of CalculiX and Abaqus in the Voigt order
/// of models/fe_tire.
inline constexpr int kVoigtOfCalculix[6] = {0, 1, 2, 3, 5, 4};

/// A direction along a local axis of an element: axis 0, 1, 2 and sign.
struct LocalDirection {
  int axis = 0;
  int sign = 1;
  LocalDirection operator-() const { return {axis, -sign}; }
  bool operator==(const LocalDirection&) const = default;
};

/// Returns the outward direction of the face with number 1 to 6.
LocalDirection face_direction(int face);

/// Returns the positions (0 to 7) in the element of the four nodes of a face, given by its outward
/// direction.
std::array<int, 4> face_corners(LocalDirection outward);

/// Returns the vector from the middle of the opposite face to the middle of the face.
Eigen::Vector3d span(const Hex& X, LocalDirection direction);

/// Returns the least volume spanned by the three edges at a corner; it is not positive if the
/// element is inverted.
double smallest_corner_volume(const Hex& X);

/// Returns the renumbering that gives an element the local axes xi, eta (right-handed) and zeta:
/// for each node its position in the present numbering. xi and zeta must belong to different axes.
std::array<int, 8> renumbering(LocalDirection xi, LocalDirection zeta);

}  // namespace latsch::formats
