// SPDX-License-Identifier: Apache-2.0
// The blocks' forces on bent sections. A block at the share s of segment k, on the line at y, is
// farther out by
//   Σ q_i(y) ((1 - s) γ_i,k + s γ_i,k+1)
// than its line, so its force F acts on γ as F . G times these factors, with G = dT/dH of (10).
#include <algorithm>
#include <vector>

#include "models/ring_tire/tread/block_arms.h"

namespace latsch::ring_tire {
namespace {

constexpr int kModes = SectionBending::kModes;
using Modes = Eigen::Vector<double, kModes>;

/// Returns the index of the first unknown of a node.
Eigen::Index first_unknown(const SectionBending& section, int node) {
  const auto& contact = section.contact();
  return kModes * (std::lower_bound(contact.begin(), contact.end(), node) - contact.begin());
}

}  // namespace

/// Sums over the lines at a station, with k = K_b G of a block, of the derivatives by the modes.
struct RingTreadContact::StationBorder {
  Eigen::Matrix<double, 3, kModes> force = Eigen::Matrix<double, 3, kModes>::Zero();  // k
  Modes tilt = Modes::Zero(), yaw = Modes::Zero();  // H, y times t . k
  Modes torsion = Modes::Zero();                    // (H a - y n) . k
  Eigen::Matrix<double, kModes, kModes> own = Eigen::Matrix<double, kModes, kModes>::Zero();
  bool touches = false;
};

void RingTreadContact::bend(const SectionBending& section) {
  if (!section.on()) return;
  if (line_shapes_.empty())
    for (const double y : line_y_)
      line_shapes_.emplace_back(section.shape(0, y), section.shape(1, y), section.shape(2, y));
  bends_ = true;
  section_rise_.resize(2 * static_cast<std::size_t>(nodes_ * lines_));
  for (int segment = 0; segment < nodes_; ++segment) {
    const Modes here = section.field().col(segment);
    const Modes next = section.field().col((segment + 1) % nodes_);
    double* rise = &section_rise_[2 * static_cast<std::size_t>(segment * lines_)];
    for (const Modes& shape : line_shapes_) {
      *rise++ = shape.dot(here);
      *rise++ = shape.dot(next);
      if (runout_.empty()) continue;
      rise[-2] += runout_[static_cast<std::size_t>(segment)];
      rise[-1] += runout_[static_cast<std::size_t>((segment + 1) % nodes_)];
    }
  }
}

std::vector<int> RingTreadContact::nodes_near_road() const {
  std::vector<int> nodes;
  for (const Patch& patch : patches_)
    for (const int m : {1, 2}) nodes.push_back(node(patch.segment, m));
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

Eigen::VectorXd RingTreadContact::section_forces(const SectionBending& section,
                                                 const NodeValues& q) const {
  Eigen::VectorXd f = Eigen::VectorXd::Zero(section.unknowns());
  see_touching(q, [&](const BlockState& block) {
    const int segment = patches_[block.patch].segment;
    const Modes force = (block.Fn * block.normal + block.F).dot(block.G) *
                        line_shapes_[static_cast<std::size_t>(block.line)];
    const double share = share_[static_cast<std::size_t>(block.station)];
    f.segment<kModes>(first_unknown(section, node(segment, 1))) += (1.0 - share) * force;
    f.segment<kModes>(first_unknown(section, node(segment, 2))) += share * force;
  });
  return f;
}

std::vector<RingTreadContact::StationBorder> RingTreadContact::station_borders(
    const NodeValues& q, bool all_stick) const {
  std::vector<StationBorder> stations(patches_.size() * static_cast<std::size_t>(stride_));
  see_touching(q, [&](const BlockState& block) {
    const auto vector = [&](int c) {
      const auto at = [&](int i) { return frame(block.patch, c + i)[block.station]; };
      return Eigen::Vector3d(at(0), at(1), at(2));
    };
    const double H = height(patches_[block.patch].segment, block.line, block.station);
    const double y = line_y_[static_cast<std::size_t>(block.line)];
    const double gripped = all_stick ? 1.0 : block.gripped, out = block.normal.dot(block.G);
    const Eigen::Vector3d k =
        block.share * (tangential_ * gripped * (block.G - out * block.normal) +
                       block.stiffer * normal_ * out * block.normal);
    const Modes& shape = line_shapes_[static_cast<std::size_t>(block.line)];
    const double along = vector(kT).dot(k);
    StationBorder& at = stations[block.patch * static_cast<std::size_t>(stride_) +
                                 static_cast<std::size_t>(block.station)];
    at.touches = true;
    at.force += k * shape.transpose();
    at.tilt += H * along * shape;
    at.yaw += y * along * shape;
    at.torsion += (H * a_ - y * vector(kN)).dot(k) * shape;
    at.own += k.dot(block.G) * shape * shape.transpose();
  });
  return stations;
}

void RingTreadContact::section_border(const SectionBending& section,
                                      const NodeValues& q,
                                      bool all_stick,
                                      Eigen::MatrixXd& B,
                                      Eigen::MatrixXd& A) const {
  B = Eigen::MatrixXd::Zero(4 * nodes_, section.unknowns());
  A = Eigen::MatrixXd::Zero(section.unknowns(), section.unknowns());
  const std::vector<StationBorder> stations = station_borders(q, all_stick);
  for (std::size_t patch = 0; patch < patches_.size(); ++patch) {
    const int segment = patches_[patch].segment;
    const Eigen::Index first[2] = {first_unknown(section, node(segment, 1)),
                                   first_unknown(section, node(segment, 2))};
    for (int j = 0; j < blocks_; ++j) {
      const StationBorder& at =
          stations[patch * static_cast<std::size_t>(stride_) + static_cast<std::size_t>(j)];
      if (!at.touches) continue;
      const Arms arms = arms_at(patch, j, 0.0, 0.0);
      const double s = share_[static_cast<std::size_t>(j)], share[2] = {1.0 - s, s};
      for (int m = 0; m < 4; ++m) {
        const double d = arms.d[m] / arms.length;
        Eigen::Matrix<double, 4, kModes> of_node;
        of_node.topRows<3>() =
            arms.w[m] * at.force - d * (arms.n * at.tilt.transpose() + a_ * at.yaw.transpose());
        of_node.row(3) = arms.w[m] * at.torsion.transpose();
        for (const int end : {0, 1})
          B.block<4, kModes>(4 * node(segment, m), first[end]) += share[end] * of_node;
      }
      for (const int end : {0, 1})
        for (const int other : {0, 1})
          A.block<kModes, kModes>(first[end], first[other]) += share[end] * share[other] * at.own;
    }
  }
}

}  // namespace latsch::ring_tire
