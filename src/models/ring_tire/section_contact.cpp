// SPDX-License-Identifier: Apache-2.0
// The blocks' forces on bent sections: a block at the share s of segment k, on the line at y,
// stands
//   Σ q_i(y) ((1 - s) γ_i,k + s γ_i,k+1)
// higher than its line, so its force F counts F . G times these factors on γ, G = dT/dH of (10).
#include <algorithm>

#include "models/ring_tire/block_arms.h"

namespace latsch::ring_tire {
namespace {

constexpr int kModes = SectionBending::kModes;

/// Factors of the unknowns at both ends of the segment, one after the other, for all lines.
struct LineShapes {
  LineShapes(const SectionBending& section, const std::vector<double>& line_y) {
    for (const double y : line_y)
      for (int i = 0; i < kModes; ++i) at.push_back(section.shape(i, y));
  }
  Eigen::Vector<double, 2 * kModes> of(int line, double share) const {
    const Eigen::Map<const Eigen::Vector<double, kModes>> q(
        &at[static_cast<std::size_t>(kModes * line)]);
    Eigen::Vector<double, 2 * kModes> factors;
    factors << (1.0 - share) * q, share * q;
    return factors;
  }
  std::vector<double> at;
};

/// Where the unknowns of a node begin.
Eigen::Index first_unknown(const SectionBending& section, int node) {
  const auto& contact = section.contact();
  return kModes * (std::lower_bound(contact.begin(), contact.end(), node) - contact.begin());
}

}  // namespace

void TreadContact::bend(const SectionBending& section) {
  if (!section.on()) return;
  rises_.resize(2 * static_cast<std::size_t>(nodes_ * lines_));
  for (int line = 0; line < lines_; ++line)
    for (int segment = 0; segment < nodes_; ++segment) {
      double* rise = &rises_[2 * static_cast<std::size_t>(segment * lines_ + line)];
      rise[0] = rise[1] = 0.0;
      for (int i = 0; i < kModes; ++i) {
        const double q = section.shape(i, line_y_[static_cast<std::size_t>(line)]);
        rise[0] += q * section.field()(i, segment);
        rise[1] += q * section.field()(i, (segment + 1) % nodes_);
      }
    }
}

std::vector<int> TreadContact::nodes_near_road() const {
  std::vector<int> nodes;
  for (const Patch& patch : patches_)
    for (const int m : {1, 2}) nodes.push_back(node(patch.segment, m));
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

Eigen::VectorXd TreadContact::section_forces(const SectionBending& section,
                                             const NodeValues& q) const {
  const LineShapes shapes(section, line_y_);
  Eigen::VectorXd f = Eigen::VectorXd::Zero(section.unknowns());
  see_touching(q, [&](const BlockState& block) {
    const int segment = patches_[block.patch].segment;
    const double force = (block.Fn * block.normal + block.F).dot(block.G);
    const auto factors = shapes.of(block.line, share_[static_cast<std::size_t>(block.station)]);
    for (const int end : {0, 1})
      f.segment<kModes>(first_unknown(section, node(segment, 1 + end))) +=
          force * factors.segment<kModes>(kModes * end);
  });
  return f;
}

void TreadContact::section_border(const SectionBending& section,
                                  const NodeValues& q,
                                  bool all_stick,
                                  Eigen::MatrixXd& B,
                                  Eigen::MatrixXd& A) const {
  const LineShapes shapes(section, line_y_);
  B = Eigen::MatrixXd::Zero(4 * nodes_, section.unknowns());
  A = Eigen::MatrixXd::Zero(section.unknowns(), section.unknowns());
  see_touching(q, [&](const BlockState& block) {
    const int segment = patches_[block.patch].segment;
    const Arms arms = arms_of(block);
    const double out = block.normal.dot(block.G);
    const double gripped = all_stick ? 1.0 : block.gripped;
    const Eigen::Vector3d KG =
        tangential_ * gripped * (block.G - out * block.normal) + normal_ * out * block.normal;
    const double own = KG.dot(block.G);
    const auto factors = shapes.of(block.line, share_[static_cast<std::size_t>(block.station)]);
    Eigen::Index first[2];
    for (const int end : {0, 1}) first[end] = first_unknown(section, node(segment, 1 + end));
    for (const int end : {0, 1}) {
      const auto of_end = factors.segment<kModes>(kModes * end);
      for (int m = 0; m < 4; ++m)
        B.block<4, kModes>(4 * node(segment, m), first[end]) +=
            arms.tip_by(m).transpose() * KG * of_end.transpose();
      for (const int other : {0, 1})
        A.block<kModes, kModes>(first[end], first[other]) +=
            own * of_end * factors.segment<kModes>(kModes * other).transpose();
    }
  });
}

}  // namespace latsch::ring_tire
