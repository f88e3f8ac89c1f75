// SPDX-License-Identifier: Apache-2.0
// A model of a few elements with prescribed displacements, assembled as dense matrices, for the
// published problems of this folder.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "models/fe_tire/element/hex8.h"
#include "models/fe_tire/element/hex8_shape.h"

namespace latsch::verification {

using namespace fe_tire;

/// Node numbers on a grid of (nx + 1) x (ny + 1) x (nz + 1) nodes; the element coordinate xi runs
/// along x.
struct Grid {
  int nx = 1, ny = 1, nz = 1;
  int node(int i, int j, int k) const { return (k * (ny + 1) + j) * (nx + 1) + i; }
  int nodes() const { return (nx + 1) * (ny + 1) * (nz + 1); }
};

class SmallModel {
 public:
  SmallModel(const Grid& grid,
             const std::function<Eigen::Vector3d(int, int, int)>& place,
             ElementKind kind,
             Materials materials,
             std::vector<RebarPlacement> rebars = {});

  /// Returns the internal forces at the displacements u [3 per node]; if K is given, it receives
  /// the tangent stiffness.
  Eigen::VectorXd forces(const Eigen::VectorXd& u, Eigen::MatrixXd* K);
  Eigen::MatrixXd mass() const;

  /// Solves by Newton's method for the free displacements, starting at u; displacements that are
  /// `held` keep their values. Returns the number of iterations, or -1 if the iteration fails.
  int solve(Eigen::VectorXd& u, const std::vector<char>& held, const Eigen::VectorXd& load);

  const Grid& grid() const { return grid_; }
  const Eigen::Matrix3Xd& X() const { return X_; }
  int unknowns() const { return 3 * grid_.nodes(); }
  const std::vector<double>& residuals() const { return residuals_; }

 private:
  Grid grid_;
  Eigen::Matrix3Xd X_;
  Materials materials_;
  std::vector<Element> elements_;
  std::vector<HexShape> shapes_;
  std::vector<double> alpha_;
  int alphas_ = 0;
  std::vector<double> residuals_;
};

/// Returns the lowest `count` eigenvalues of K x = lambda M x over the unknowns that are not held.
std::vector<double> eigenvalues(const Eigen::MatrixXd& K,
                                const Eigen::MatrixXd& M,
                                const std::vector<char>& held,
                                int count);

/// A pseudo-random sequence of numbers in [-1, 1] that is the same in every run.
class Sequence {
 public:
  double next() {
    state_ = state_ * 6364136223846793005ull + 1442695040888963407ull;
    return static_cast<double>(state_ >> 11) / 4503599627370496.0 - 1.0;
  }

 private:
  unsigned long long state_ = 1;
};

}  // namespace latsch::verification
