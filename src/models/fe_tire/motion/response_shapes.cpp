// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/motion/response_shapes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "numerics/sparse/lanczos.h"

namespace latsch::fe_tire {
namespace {

constexpr int kFirstModes = 48;  // modes that are computed at first
/// A large block: orthogonalization reads all vectors once a step, which costs more than solutions.
constexpr int kShapeBlock = 24;
/// Residual relative to the inverse eigenvalue. It may be large, because the vectors only have to
/// span the space.
constexpr double kApproximate = 1e-2;
/// The number of a tire's modes below a frequency grows with about this power of it.
constexpr double kModeGrowth = 2.0, kMostModeGrowth = 4.0, kLeastModeGrowth = 1.3;
/// Share of a vector's norm that is new; with less, the vector is in the space.
constexpr double kNew = 1e-7;

}  // namespace

Result<Eigen::MatrixXd> modes_up_to(double limit,
                                    const numerics::Factorization& factor,
                                    const numerics::SymmetricMatrix& M) {
  numerics::EigenProblem<double> problem;
  problem.size = M.size();
  problem.solve = [&](Eigen::Ref<Eigen::MatrixXd> X) { factor.solve_roughly(X); };
  problem.mass = [&](const Eigen::Ref<const Eigen::MatrixXd>& X, Eigen::Ref<Eigen::MatrixXd> Y) {
    M.multiply(X, Y);
  };
  Eigen::MatrixXd start;
  for (int count = std::min(kFirstModes, M.size());;) {
    const auto found = numerics::lanczos(
        problem, {.count = count, .tolerance = kApproximate, .block = kShapeBlock}, start);
    if (!found.converged)
      return Failure{fmt::format("response: Lanczos found {} of {} modes in {} solves",
                                 found.values.size(),
                                 count,
                                 found.solves)};
    const auto hertz = [&](Eigen::Index k) {
      return std::sqrt(std::max(0.0, found.values[k])) / (2.0 * std::numbers::pi);
    };
    const Eigen::Index last = found.values.size() - 1;
    if (hertz(last) >= limit || count == M.size()) {
      Eigen::Index within = 1;
      while (within <= last && hertz(within) < limit) ++within;
      return Eigen::MatrixXd(found.vectors.leftCols(within));
    }
    const double growth =
        std::clamp(std::pow(limit / hertz(last), kModeGrowth), kLeastModeGrowth, kMostModeGrowth);
    count = std::min(M.size(), static_cast<int>(std::ceil(count * growth)));
    start = found.vectors;
  }
}

void append_orthogonal(const Eigen::MatrixXd& vectors,
                       const numerics::SymmetricMatrix& M,
                       Eigen::MatrixXd& basis) {
  for (Eigen::Index k = 0; k < vectors.cols(); ++k) {
    Eigen::VectorXd v = vectors.col(k), Mv(v.size());
    M.multiply(v.data(), Mv.data());
    const double whole = std::sqrt(std::max(0.0, v.dot(Mv)));
    if (!(whole > 0.0)) continue;
    double rest = whole;
    // Twice, because the first pass leaves an error of rounding that is large beside a small rest.
    for (int pass = 0; pass < 2; ++pass) {
      v -= basis * (basis.transpose() * Mv).eval();
      M.multiply(v.data(), Mv.data());
      rest = std::sqrt(std::max(0.0, v.dot(Mv)));
    }
    if (rest <= kNew * whole) continue;
    basis.conservativeResize(Eigen::NoChange, basis.cols() + 1);
    basis.rightCols(1) = v / rest;
  }
}

}  // namespace latsch::fe_tire
