// SPDX-License-Identifier: Apache-2.0
#include "models/ring_tire/ring/exact_tangent.h"

#include <algorithm>

namespace latsch::ring_tire {

ExactTangent::ExactTangent(const CyclicBandFactor& factor,
                           const SectionBending& section,
                           const std::vector<PatchSlopes>& exact,
                           const CyclicBand& approximate,
                           const Eigen::MatrixXd& B,
                           const Eigen::MatrixXd& A,
                           double scale)
    : factor_(factor), section_(section) {
  const int N = approximate.nodes();
  std::vector<int> nodes;
  for (const PatchSlopes& patch : exact)
    nodes.insert(nodes.end(), std::begin(patch.nodes), std::end(patch.nodes));
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  const Eigen::Index sections = section.on() ? section.unknowns() : 0;
  const Eigen::Index belt = 4 * static_cast<Eigen::Index>(nodes.size()), count = belt + sections;
  if (nodes.empty()) return;
  for (const int node : nodes)
    for (int i = 0; i < 4; ++i) rows_.push_back(4 * node + i);
  for (Eigen::Index i = 0; i < sections; ++i) rows_.push_back(4 * N + i);

  const auto place_of = [](const std::vector<int>& in, int node) -> Eigen::Index {
    return std::lower_bound(in.begin(), in.end(), node) - in.begin();
  };
  E_ = Eigen::MatrixXd::Zero(count, count);
  for (const PatchSlopes& patch : exact) {
    Eigen::Index at[PatchSlopes::kAll];
    for (int i = 0; i < PatchSlopes::kNodes; ++i)
      at[i] = 4 * place_of(nodes, patch.nodes[i / 4]) + i % 4;
    constexpr int kModes = SectionBending::kModes;
    for (int i = 0; i < 2 * kModes; ++i)
      at[PatchSlopes::kNodes + i] =
          belt + kModes * place_of(section.contact(), patch.nodes[1 + i / kModes]) + i % kModes;
    const int all = sections > 0 ? PatchSlopes::kAll : PatchSlopes::kNodes;
    for (int j = 0; j < all; ++j)
      for (int i = 0; i < all; ++i) E_(at[i], at[j]) -= scale * patch.forces(i, j);
  }
  for (const int node : nodes) {
    const Eigen::Index own = 4 * place_of(nodes, node);
    for (int j = 0; j <= CyclicBand::kReach; ++j) {
      const Eigen::Index other = place_of(nodes, (node + j) % N);
      if (other == static_cast<Eigen::Index>(nodes.size()) ||
          nodes[static_cast<std::size_t>(other)] != (node + j) % N)
        continue;
      E_.block<4, 4>(own, 4 * other) -= approximate.block(node, j);
      if (j > 0) E_.block<4, 4>(4 * other, own) -= approximate.block(node, j).transpose();
    }
  }
  if (sections > 0) {
    const std::vector<Eigen::Index> of_belt(rows_.begin(), rows_.begin() + belt);
    const Eigen::MatrixXd border = scale * B(of_belt, Eigen::all);
    E_.topRightCorner(belt, sections) -= border;
    E_.bottomLeftCorner(sections, belt) -= border.transpose();
    E_.bottomRightCorner(sections, sections) -= scale * A;
  }
  Columns units = Columns::Zero(4 * N + sections, (count + 7) / 8 * 8);
  for (Eigen::Index i = 0; i < count; ++i) units(rows_[static_cast<std::size_t>(i)], i) = 1.0;
  solve_approximately(units);
  const Eigen::MatrixXd S = units.leftCols(count)(rows_, Eigen::all);
  Eigen::MatrixXd whole = Eigen::MatrixXd::Identity(count, count);
  whole.noalias() += E_ * S;
  lu_ = std::make_unique<numerics::Lu>(whole);
}

void ExactTangent::solve_approximately(Columns& x) const {
  if (section_.on())
    section_.solve(factor_, x);
  else
    factor_.solve(x);
}

void ExactTangent::solve(Columns& x) const {
  if (!rows_.empty()) {
    Columns y = x;
    solve_approximately(y);
    const Eigen::MatrixXd w = lu_->solve(E_ * y(rows_, Eigen::all));
    for (std::size_t i = 0; i < rows_.size(); ++i)
      x.row(rows_[i]) -= w.row(static_cast<Eigen::Index>(i));
  }
  solve_approximately(x);
}

}  // namespace latsch::ring_tire
