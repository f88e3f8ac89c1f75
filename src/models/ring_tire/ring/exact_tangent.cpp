// SPDX-License-Identifier: Apache-2.0
#include "models/ring_tire/ring/exact_tangent.h"

#include <algorithm>

namespace latsch::ring_tire {

namespace {

void solve_approximately(const CyclicBandFactor& factor,
                         const SectionBending& section,
                         Eigen::Ref<SideBySide> x) {
  if (section.on())
    section.solve_columns(factor, x);
  else
    factor.solve_columns(x);
}

Eigen::Index place_of(const std::vector<int>& in, int node) {
  return std::lower_bound(in.begin(), in.end(), node) - in.begin();
}

}  // namespace

Eigen::Index patch_row(const PatchSlopes& patch,
                       int entry,
                       const SectionBending& section,
                       int nodes) {
  if (entry < PatchSlopes::kNodes) return 4 * patch.nodes[entry / 4] + entry % 4;
  constexpr int kModes = SectionBending::kModes;
  const int of = entry - PatchSlopes::kNodes;
  return 4 * nodes + kModes * place_of(section.contact(), patch.nodes[1 + of / kModes]) +
         of % kModes;
}

/// Computes the matrix E among the unknowns of the contact patches.
void ExactTangent::find_left_out(const SectionBending& section,
                                 const std::vector<PatchSlopes>& exact,
                                 const CyclicBand& approximate,
                                 const Eigen::MatrixXd& B,
                                 const Eigen::MatrixXd& A,
                                 double scale) {
  const int N = approximate.nodes();
  std::vector<int>& nodes = nodes_;
  nodes.clear();
  rows_.clear();
  for (const PatchSlopes& patch : exact)
    nodes.insert(nodes.end(), std::begin(patch.nodes), std::end(patch.nodes));
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  const Eigen::Index sections = section.unknowns();
  const Eigen::Index belt = 4 * static_cast<Eigen::Index>(nodes.size()), count = belt + sections;
  for (const int node : nodes)
    for (int i = 0; i < 4; ++i) rows_.push_back(4 * node + i);
  for (Eigen::Index i = 0; i < sections; ++i) rows_.push_back(4 * N + i);

  E_.setZero(count, count);
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
}

void ExactTangent::find(const CyclicBandFactor& factor,
                        const SectionBending& section,
                        const std::vector<PatchSlopes>& exact,
                        const CyclicBand& approximate,
                        const Eigen::MatrixXd& B,
                        const Eigen::MatrixXd& A,
                        double scale) {
  find_left_out(section, exact, approximate, B, A, scale);
  const Eigen::Index count = E_.rows(), all = 4 * approximate.nodes() + section.unknowns();
  if (count == 0) return;
  S_.resize(count, count);
  y_.resize(all, 8);
  for (Eigen::Index first = 0; first < count; first += 8) {
    const Eigen::Index some = std::min<Eigen::Index>(8, count - first);
    y_.setZero();
    for (Eigen::Index i = 0; i < some; ++i) y_(rows_[static_cast<std::size_t>(first + i)], i) = 1.0;
    solve_approximately(factor, section, y_);
    S_.middleCols(first, some) = y_(rows_, Eigen::seqN(0, some));
  }
  whole_.setIdentity(count, count);
  whole_.noalias() += E_ * S_;
  lu_.factorize(whole_);
}

void ExactTangent::solve(const CyclicBandFactor& factor,
                         const SectionBending& section,
                         Eigen::Ref<SideBySide> x) {
  if (!rows_.empty()) {
    y_ = x;
    solve_approximately(factor, section, y_);
    y_c_ = y_(rows_, Eigen::all);
    w_.noalias() = E_ * y_c_;
    lu_.solve(w_);
    for (std::size_t i = 0; i < rows_.size(); ++i)
      x.row(rows_[i]) -= w_.row(static_cast<Eigen::Index>(i));
  }
  solve_approximately(factor, section, x);
}

}  // namespace latsch::ring_tire
