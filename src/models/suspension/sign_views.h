// SPDX-License-Identifier: Apache-2.0
// Sign conventions of three systems of axes, as factors by which results in ISO 8855 are
// multiplied. A quantity is directed along an axis or about an axis, or it has the same sign in all
// conventions (toe-in, camber, lengths, heights above ground).
//
//   iso    x forward,  y left,  z up          ISO 8855
//   sae    x forward,  y right, z down        SAE J670, 1976
//   adams  x rearward, y right, z up          as car models of Adams are built: toward the aft
//
// With s the signs of the axes, a quantity along axis i is multiplied by s_i, and a quantity about
// axis i by the product of the other two. So steer to the left is positive in iso and adams, steer
// to the right in sae; toe-in and camber with the top outboard are positive in all three.
#pragma once

#include <array>
#include <cstddef>

namespace latsch::suspension {

enum class Sense { same, along_x, along_y, along_z, about_x, about_y, about_z };
enum class SignView { iso, sae, adams };

/// Sense in which a quantity is positive. If it is a derivative, `by` is the sense of the quantity
/// by which it is differentiated.
struct SignSense {
  Sense of = Sense::same, by = Sense::same;
};

using AxisSigns = std::array<double, 3>;

inline constexpr std::array<AxisSigns, 3> kAxisSigns = {
    {{1.0, 1.0, 1.0}, {1.0, -1.0, -1.0}, {-1.0, -1.0, 1.0}}};
/// Signs of the mirror reflection that turns a left wheel into a right one.
inline constexpr AxisSigns kMirror = {1.0, -1.0, 1.0};

constexpr double sign(const AxisSigns& s, Sense sense) {
  switch (sense) {
    case Sense::along_x:
      return s[0];
    case Sense::along_y:
      return s[1];
    case Sense::along_z:
      return s[2];
    case Sense::about_x:
      return s[1] * s[2];
    case Sense::about_y:
      return s[2] * s[0];
    case Sense::about_z:
      return s[0] * s[1];
    case Sense::same:
      break;
  }
  return 1.0;
}

constexpr double sign(SignView view, Sense of, Sense by = Sense::same) {
  const AxisSigns& s = kAxisSigns[static_cast<std::size_t>(view)];
  return sign(s, of) * sign(s, by);
}

}  // namespace latsch::suspension
