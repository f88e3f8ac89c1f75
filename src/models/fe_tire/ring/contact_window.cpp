// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/ring/contact_window.h"

#include <algorithm>
#include <numbers>

namespace latsch::fe_tire {
namespace {

// rad to both sides: a circle cut there is pressed in by 8 % of its radius. Deeper ones lose speed,
// nothing else.
constexpr double kHalfAngle = 0.4;

}  // namespace

ContactWindow::ContactWindow(const RingUnknowns& unknowns)
    : unknowns_(unknowns), holds_(unknowns.sectors(), false) {
  const Mesh& mesh = unknowns.ring().mesh();
  if (mesh.sectors == 1) return;
  for (int s = 0; s < unknowns.sectors(); ++s) {
    const double nearest = std::min(mesh.angle(s), 2.0 * std::numbers::pi - mesh.angle(s + 1));
    holds_[s] = nearest < kHalfAngle;
    for (int e = 0, face = 0; holds_[s] && e < unknowns.ring().elements_per_sector(); ++e) {
      if (!mesh.elements[e].tread) continue;
      faces_.push_back({s, face++, {}});
      for (int a = 0; a < 4; ++a) {
        if (unknowns.first_unknown(s, e, 4 + a) < 0) {
          clear();
          return;
        }
        faces_.back().node[a] = node_of(s, e, 4 + a);
      }
    }
  }
}

/// A tread that the rim holds somewhere has no window.
void ContactWindow::clear() {
  holds_.assign(holds_.size(), false);
  nodes_.clear();
  block_rows_.clear();
  faces_.clear();
}

/// The node of an element's corner; enters it where it is not known yet.
int ContactWindow::node_of(int sector, int element, int corner) {
  const int first = unknowns_.first_unknown(sector, element, corner);
  const auto known = std::ranges::find(block_rows_, first / 3);
  if (known != block_rows_.end()) return static_cast<int>(known - block_rows_.begin());
  const Mesh& mesh = unknowns_.ring().mesh();
  const int n = mesh.nodes_per_sector(), node = mesh.elements[element].node[corner];
  const Eigen::Matrix3d frame = mesh.frame((sector + (node < n ? 0 : 1)) % mesh.sectors);
  block_rows_.push_back(first / 3);
  nodes_.push_back({frame.row(2), (frame * mesh.X.col(node % n)).z()});
  return nodes() - 1;
}

Eigen::VectorXd ContactWindow::heights(const Eigen::VectorXd& x) const {
  Eigen::VectorXd z(nodes());
  for (int k = 0; k < nodes(); ++k) {
    z[k] = nodes_[k].height + nodes_[k].up.dot(x.segment<3>(3 * block_rows_[k]));
  }
  return z;
}

Eigen::VectorXd ContactWindow::forces(const GroundContact& contact,
                                      const Eigen::VectorXd& heights,
                                      Eigen::MatrixXd* stiffness) const {
  Eigen::VectorXd c = Eigen::VectorXd::Zero(nodes());
  if (stiffness) stiffness->setZero(nodes(), nodes());
  for (const Face& face : faces_) {
    const GroundContact::Face& points = contact.faces(face.sector)[face.index];
    for (int q = 0; q < 4; ++q) {
      const Eigen::Vector4d& N = points.N[q];
      double above = -contact.height();
      for (int a = 0; a < 4; ++a) above += N[a] * heights[face.node[a]];
      if (above >= 0.0) continue;
      const double k = contact.ground().stiffness * points.dA[q];
      for (int a = 0; a < 4; ++a) {
        c[face.node[a]] += k * above * N[a];
        for (int b = 0; stiffness && b < 4; ++b) {
          (*stiffness)(face.node[a], face.node[b]) += k * N[a] * N[b];
        }
      }
    }
  }
  return c;
}

}  // namespace latsch::fe_tire
