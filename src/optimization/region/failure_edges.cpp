// SPDX-License-Identifier: Apache-2.0
#include "optimization/region/failure_edges.h"

#include <algorithm>
#include <optional>

#include "optimization/problem/quadratic_program.h"

namespace latsch {
namespace {

constexpr int kFewest = 3;  // smallest number of failures that can form an edge
// Share of the failures that must be predicted when they are left out of the fit of the plane.
constexpr double kForetold = 0.7;
constexpr int kMostEdges = 3;
// Largest number of failures of one edge, as a multiple of n + 1; the nearest ones are used.
constexpr int kMostEdgeFailures = 2;
// Weight of b^2 in the minimization. It is small beside that of |a|^2, which is 1, so that b is
// nearly free.
constexpr double kOffset = 1e-6;

/// Returns the plane midway in the widest gap between failures and successes; nullopt if no plane
/// separates them.
std::optional<Edge> plane(const std::vector<Eigen::VectorXd>& failures,
                          const std::vector<Eigen::VectorXd>& successes) {
  const auto n = failures.front().size();
  const double unit = failures.front().norm();  // scales lengths to about 1
  QuadraticProgram program;
  program.G = Eigen::MatrixXd::Identity(n + 1, n + 1);
  program.G(n, n) = kOffset;
  program.g = Eigen::VectorXd::Zero(n + 1);
  program.E.resize(0, n + 1);
  program.f.resize(0);
  program.A.resize(std::ssize(failures) + std::ssize(successes) + 1, n + 1);
  program.b = -Eigen::VectorXd::Ones(program.A.rows());
  Eigen::Index row = 0;
  for (const Eigen::VectorXd& x : failures) {
    program.A.row(row).head(n) = -x.transpose() / unit;
    program.A(row++, n) = 1.0;
  }
  for (const Eigen::VectorXd& x : successes) {
    program.A.row(row).head(n) = x.transpose() / unit;
    program.A(row++, n) = -1.0;
  }
  program.A.row(row).setZero();  // row of the success at the origin
  program.A(row, n) = -1.0;
  const QuadraticSolution found = solve(program);
  const double length = found.x.head(n).norm();
  if (!found.is_feasible() || !(length > 0.0)) return std::nullopt;
  const Edge edge{found.x.head(n) / length, found.x[n] / length * unit};
  const auto is_beyond = [&](const Eigen::VectorXd& x) { return edge.a.dot(x) > edge.b; };
  const bool parts = edge.b > 0.0 && std::all_of(failures.begin(), failures.end(), is_beyond) &&
                     std::none_of(successes.begin(), successes.end(), is_beyond);
  return parts ? std::optional(edge) : std::nullopt;
}

/// True if planes fitted without each failure in turn predict most of the failures left out: the
/// failure lies farther out than all successes. (It need not lie beyond the plane. The innermost
/// failure never does, because the plane is midway between successes and the other failures.)
bool foretells(const std::vector<Eigen::VectorXd>& failures,
               const std::vector<Eigen::VectorXd>& successes) {
  const auto is_foretold = [&](const Eigen::VectorXd& x) {
    std::vector<Eigen::VectorXd> others;
    for (const Eigen::VectorXd& other : failures) {
      // A point that failed twice is in the list twice.
      if (&other != &x) others.push_back(other);
    }
    const std::optional<Edge> edge = plane(others, successes);
    if (!edge) return false;
    const double out = edge->a.dot(x);
    return out > 0.0 && std::all_of(successes.begin(), successes.end(), [&](const auto& success) {
             return out > edge->a.dot(success);
           });
  };
  const auto foretold = std::count_if(failures.begin(), failures.end(), is_foretold);
  return static_cast<double>(foretold) >= kForetold * static_cast<double>(failures.size());
}

}  // namespace

std::vector<Edge> failure_edges(const std::vector<Eigen::VectorXd>& failures,
                                const std::vector<Eigen::VectorXd>& successes) {
  std::vector<Edge> edges;
  std::vector<Eigen::VectorXd> left = failures;
  while (std::ssize(left) >= kFewest && std::ssize(edges) < kMostEdges) {
    const auto n = static_cast<std::size_t>(left.front().size());
    std::vector<Eigen::VectorXd> some = left;  // the failures that are nearest to the first one
    std::stable_sort(some.begin(), some.end(), [&](const auto& x, const auto& y) {
      return (x - left.front()).squaredNorm() < (y - left.front()).squaredNorm();
    });
    some.resize(std::min(some.size(), kMostEdgeFailures * (n + 1)));
    std::optional<Edge> edge;
    for (; !edge && std::ssize(some) >= kFewest; some.resize((some.size() + 1) / 2)) {
      edge = plane(some, successes);
      if (edge && !foretells(some, successes)) edge.reset();
      if (some.size() == kFewest) break;
    }
    if (!edge) {
      left.erase(left.begin());
      continue;
    }
    edges.push_back(*edge);
    std::erase_if(left, [&](const Eigen::VectorXd& x) { return edge->a.dot(x) > edge->b; });
  }
  return edges;
}

}  // namespace latsch
