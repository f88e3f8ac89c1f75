// SPDX-License-Identifier: Apache-2.0
#include "optimization/trust_region/natural_frame.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "numerics/dense/orthogonal_factors.h"
#include "numerics/dense/singular_values.h"

namespace latsch {
namespace {

constexpr double kOnBound = 1e-9;

/// Orthonormal vectors that span the possible moves, in units of the widths. Variables at a bound
/// are listed separately.
struct Groups {
  Eigen::MatrixXd free;            // directions as columns, in units of the widths
  std::vector<Eigen::Index> held;  // indices of the variables at a bound
};

Groups groups(const Eigen::VectorXd& u, const Eigen::MatrixXd& along) {
  const auto n = u.size();
  if (along.cols() < n) return {along, {}};
  Groups found{Eigen::MatrixXd(n, 0), {}};
  for (Eigen::Index i = 0; i < n; ++i) {
    if (u[i] < kOnBound || u[i] > 1.0 - kOnBound) {
      found.held.push_back(i);
      continue;
    }
    found.free.conservativeResize(Eigen::NoChange, found.free.cols() + 1);
    found.free.col(found.free.cols() - 1) = Eigen::VectorXd::Unit(n, i);
  }
  return found;
}

}  // namespace

NaturalFrame natural_frame(const Eigen::MatrixXd& slopes,
                           double r,
                           const Eigen::VectorXd& u,
                           const Eigen::VectorXd& widths,
                           const Eigen::MatrixXd& along,
                           const FrameLengths& lengths) {
  Eigen::MatrixXd J = slopes;
  if (!J.allFinite()) J.setZero();
  const Groups split = groups(u, along);
  NaturalFrame frame{Eigen::MatrixXd(u.size(), 0), {}};
  const auto add = [&](const Eigen::VectorXd& direction, double felt) {  // in widths
    const double wanted = r / std::max(felt, std::numeric_limits<double>::min());
    const Eigen::VectorXd move = widths.cwiseProduct(direction);
    const double longest = lengths.longest / move.lpNorm<Eigen::Infinity>();
    frame.T.conservativeResize(Eigen::NoChange, frame.T.cols() + 1);
    frame.T.col(frame.T.cols() - 1) = std::min(std::max(wanted, lengths.shortest), longest) * move;
  };
  if (split.free.cols() > 0) {
    const auto [s, V] = numerics::singular_values(J * widths.asDiagonal() * split.free);
    for (Eigen::Index k = 0; k < V.cols(); ++k) {
      add(split.free * V.col(k), k < s.size() ? s[k] : 0.0);
    }
  }
  for (const Eigen::Index i : split.held) {
    add(Eigen::VectorXd::Unit(u.size(), i), J.col(i).norm() * widths[i]);
  }
  if (frame.axes() == 0) return frame;
  const Eigen::MatrixXd scaled = widths.cwiseInverse().asDiagonal() * frame.T;
  const Eigen::MatrixXd unit = widths.cwiseInverse().asDiagonal();
  frame.inverse = numerics::shortest_solution(scaled, unit);
  return frame;
}

}  // namespace latsch
