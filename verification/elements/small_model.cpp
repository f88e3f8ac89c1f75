// SPDX-License-Identifier: Apache-2.0
#include "small_model.h"

#include <utility>

#include "numerics/dense/cholesky.h"
#include "numerics/dense/self_adjoint_eigen.h"

namespace latsch::verification {
namespace {

std::vector<int> free_of(const std::vector<char>& held) {
  std::vector<int> free;
  for (int i = 0; i < static_cast<int>(held.size()); ++i) {
    if (!held[i]) free.push_back(i);
  }
  return free;
}

}  // namespace

SmallModel::SmallModel(const Grid& grid,
                       const std::function<Eigen::Vector3d(int, int, int)>& place,
                       ElementKind kind,
                       Materials materials,
                       std::vector<RebarPlacement> rebars)
    : grid_(grid),
      X_(3, grid.nodes()),
      materials_(std::move(materials)),
      alphas_(internal_parameters(kind)) {
  for (int k = 0; k <= grid.nz; ++k) {
    for (int j = 0; j <= grid.ny; ++j) {
      for (int i = 0; i <= grid.nx; ++i) X_.col(grid.node(i, j, k)) = place(i, j, k);
    }
  }
  for (int k = 0; k < grid.nz; ++k) {
    for (int j = 0; j < grid.ny; ++j) {
      for (int i = 0; i < grid.nx; ++i) {
        Element element;
        for (int top = 0; top < 2; ++top) {
          element.node[4 * top + 0] = grid.node(i, j, k + top);
          element.node[4 * top + 1] = grid.node(i + 1, j, k + top);
          element.node[4 * top + 2] = grid.node(i + 1, j + 1, k + top);
          element.node[4 * top + 3] = grid.node(i, j + 1, k + top);
        }
        element.rebars = rebars;
        Matrix38 X;
        for (int a = 0; a < 8; ++a) X.col(a) = X_.col(element.node[a]);
        shapes_.push_back(make_shape(kind, X));
        elements_.push_back(element);
      }
    }
  }
  alpha_.assign(alphas_ * elements_.size() + 1, 0.0);
}

Eigen::VectorXd SmallModel::forces(const Eigen::VectorXd& u, Eigen::MatrixXd* K) {
  Eigen::VectorXd f = Eigen::VectorXd::Zero(unknowns());
  if (K) K->setZero(unknowns(), unknowns());
  for (size_t e = 0; e < elements_.size(); ++e) {
    const auto& node = elements_[e].node;
    Matrix38 ue;
    for (int a = 0; a < 8; ++a) ue.col(a) = u.segment<3>(3 * node[a]);
    Vector24 fe;
    Matrix24 Ke;
    double* alpha = alpha_.data() + alphas_ * e;
    if (!evaluate(shapes_[e], materials_, elements_[e], ue, alpha, fe, K ? &Ke : nullptr)) {
      return Eigen::VectorXd::Constant(unknowns(), std::nan(""));
    }
    for (int a = 0; a < 8; ++a) {
      f.segment<3>(3 * node[a]) += fe.segment<3>(3 * a);
      for (int b = 0; K && b < 8; ++b) {
        K->block<3, 3>(3 * node[a], 3 * node[b]) += Ke.block<3, 3>(3 * a, 3 * b);
      }
    }
  }
  return f;
}

Eigen::MatrixXd SmallModel::mass() const {
  Eigen::MatrixXd M = Eigen::MatrixXd::Zero(unknowns(), unknowns());
  for (size_t e = 0; e < elements_.size(); ++e) {
    const Matrix8 Me = fe_tire::mass(shapes_[e], materials_, elements_[e]);
    for (int a = 0; a < 8; ++a) {
      for (int b = 0; b < 8; ++b) {
        for (int i = 0; i < 3; ++i) {
          M(3 * elements_[e].node[a] + i, 3 * elements_[e].node[b] + i) += Me(a, b);
        }
      }
    }
  }
  return M;
}

int SmallModel::solve(Eigen::VectorXd& u,
                      const std::vector<char>& held,
                      const Eigen::VectorXd& load) {
  const std::vector<int> free = free_of(held);
  residuals_.clear();
  Eigen::MatrixXd K;
  for (int iteration = 0; iteration < 30; ++iteration) {
    const Eigen::VectorXd f = forces(u, &K);
    if (!f.allFinite()) return -1;
    const Eigen::VectorXd r = (load - f)(free);
    residuals_.push_back(r.norm());
    if (r.norm() <= 1e-12 * (f.norm() + load.norm())) return iteration;
    u(free) += numerics::PivotedCholesky(K(free, free)).solve(r);
  }
  return -1;
}

std::vector<double> eigenvalues(const Eigen::MatrixXd& K,
                                const Eigen::MatrixXd& M,
                                const std::vector<char>& held,
                                int count) {
  const std::vector<int> free = free_of(held);
  const Eigen::MatrixXd K_free = K(free, free), M_free = M(free, free);
  const Eigen::VectorXd values = numerics::generalized_eigenvalues(K_free, M_free);
  return {values.begin(), values.begin() + count};
}

}  // namespace latsch::verification
