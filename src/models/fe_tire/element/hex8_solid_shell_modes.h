// SPDX-License-Identifier: Apache-2.0
// Modal vectors of the solid-shell, and the products of two of them that appear in its strains.
#pragma once

#include <Eigen/Core>

namespace latsch::fe_tire::solid_shell {

/// Modal vectors of the position x:
///   x = x_0 + x_1 xi + x_2 eta + x_3 zeta + x_12 xi eta + x_23 eta zeta + x_13 xi zeta
///       + x_123 xi eta zeta
enum ElementMode { k1, k2, k3, k12, k23, k13, k123 };

/// A product of two modal vectors in a strain coefficient: e += x_m . x_n - X_m . X_n.
struct Pair {
  int e;
  ElementMode m, n;
};

/// Strain coefficients: e_0-2 are E_11 along eta, zeta, eta zeta; e_3-5 are E_22 along xi, zeta, xi
/// zeta; e_6-8 are E_33 along xi, eta, xi eta; e_9 is 2 E_12 along zeta; e_10 is 2 E_13 along eta;
/// e_11 is 2 E_23 along xi.
inline constexpr Pair kPairs[] = {{0, k1, k12},
                                  {1, k1, k13},
                                  {2, k1, k123},
                                  {2, k12, k13},
                                  {3, k2, k12},
                                  {4, k2, k23},
                                  {5, k2, k123},
                                  {5, k12, k23},
                                  {6, k3, k13},
                                  {7, k3, k23},
                                  {8, k3, k123},
                                  {8, k13, k23},
                                  {9, k1, k23},
                                  {9, k13, k2},
                                  {10, k1, k23},
                                  {10, k12, k3},
                                  {11, k2, k13},
                                  {11, k12, k3}};

/// Square of the component of an hourglass vector z_m along an axis of the element.
struct Square {
  int z;     // 0: z_12, 1: z_23, 2: z_13
  int axis;  // 0: along xi, 1: across it, 2: along the normal
};
inline constexpr Square kSquares[7] = {{0, 0}, {0, 1}, {0, 2}, {2, 0}, {2, 1}, {1, 0}, {1, 1}};

/// Returns the matrix h that gives the modal vectors: x_m = sum_a x_a h_m[a].
Eigen::Matrix<double, 7, 8> modal_matrix();

}  // namespace latsch::fe_tire::solid_shell
