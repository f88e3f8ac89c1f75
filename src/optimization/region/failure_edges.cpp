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
// Distance behind the plane's own side of the gap, as a share of half the gap, within which a
// failure holds the plane.
constexpr double kHolds = 1e-6;

/// The plane midway in the widest gap between failures and successes.
struct Gap {
  Edge edge;
  /// For each failure, true if it lies at the side of the gap. The plane stays the same without any
  /// other one.
  std::vector<bool> holds;
};

/// Returns the widest gap; nullopt if no plane separates failures from successes.
std::optional<Gap> widest_gap(const std::vector<Eigen::VectorXd>& failures,
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
  if (!parts) return std::nullopt;
  Gap gap{edge, {}};
  for (const Eigen::VectorXd& x : failures) {
    gap.holds.push_back(found.x.head(n).dot(x) / unit - found.x[n] < 1.0 + kHolds);
  }
  return gap;
}

/// True if planes fitted without each failure in turn predict most of the failures left out: the
/// failure lies farther out than all successes. (It need not lie beyond the plane. The innermost
/// failure never does, because the plane is midway between successes and the other failures.)
bool foretells(const Gap& gap,
               const std::vector<Eigen::VectorXd>& failures,
               const std::vector<Eigen::VectorXd>& successes) {
  const auto is_farthest = [&](const Eigen::VectorXd& x, const Edge& edge) {
    const double out = edge.a.dot(x);
    return out > 0.0 && std::all_of(successes.begin(), successes.end(), [&](const auto& success) {
             return out > edge.a.dot(success);
           });
  };
  const auto is_foretold = [&](std::size_t left_out) {
    if (!gap.holds[left_out]) return is_farthest(failures[left_out], gap.edge);
    std::vector<Eigen::VectorXd> others = failures;
    others.erase(others.begin() + static_cast<long>(left_out));
    const std::optional<Gap> without = widest_gap(others, successes);
    return without && is_farthest(failures[left_out], without->edge);
  };
  const double bearable = (1.0 - kForetold) * static_cast<double>(failures.size());
  int missed = 0;
  for (std::size_t i = 0; i < failures.size() && missed <= bearable; ++i) {
    missed += !is_foretold(i);
  }
  return missed <= bearable;
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
      const std::optional<Gap> gap = widest_gap(some, successes);
      if (gap && foretells(*gap, some, successes)) edge = gap->edge;
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
