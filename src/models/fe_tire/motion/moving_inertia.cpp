// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/motion/moving_inertia.h"

#include <Eigen/Geometry>

#include "models/fe_tire/motion/spin.h"
#include "numerics/dense/dense_products.h"

namespace latsch::fe_tire {
namespace {

/// Indices of an element's nodes among those of the whole ring.
std::array<int, 8> nodes_of(const Ring& ring, int sector, const Element& element) {
  const int n = ring.mesh().nodes_per_sector();
  std::array<int, 8> nodes;
  for (int a = 0; a < 8; ++a) {
    const int plane = (sector + element.node[a] / n) % ring.sectors();
    nodes[a] = plane * n + element.node[a] % n;
  }
  return nodes;
}

Matrix38 gathered(const Eigen::Matrix3Xd& of, const std::array<int, 8>& nodes) {
  Matrix38 at;
  for (int a = 0; a < 8; ++a) at.col(a) = of.col(nodes[a]);
  return at;
}

}  // namespace

MovingInertia::MovingInertia(const RingElements& elements)
    : ring_(elements.ring()), sectors_(ring_.widths()), of_width_(ring_.widths()) {
  const Mesh& mesh = ring_.mesh();
  const int n = mesh.nodes_per_sector();
  X_.resize(3, mesh.nodes());
  for (int s = 0; s < ring_.sectors(); ++s) {
    frames_.push_back(mesh.frame(s));
    X_.middleCols(s * n, n) = frames_.back() * mesh.X;
    sectors_[ring_.width(s)].push_back(s);
    std::vector<Scalars>& known = of_width_[ring_.width(s)];
    if (!known.empty()) continue;
    for (int e = 0; e < ring_.elements_per_sector(); ++e) {
      const FlowInertia of =
          flow_inertia(ring_.shape(s, e), elements.materials(), mesh.elements[e]);
      known.push_back({of.M, of.G, of.W});
    }
  }
}

/// Turns vectors at all nodes from sector frames to the wheel's axes.
Eigen::Matrix3Xd MovingInertia::in_wheel_axes(const Eigen::Matrix3Xd& of) const {
  const int n = ring_.mesh().nodes_per_sector();
  Eigen::Matrix3Xd turned(3, of.cols());
  for (int s = 0; s < ring_.sectors(); ++s)
    turned.middleCols(s * n, n).noalias() = frames_[s] * of.middleCols(s * n, n);
  return turned;
}

MovingInertia::Forces MovingInertia::forces(const Motion& motion) const {
  const double spin = motion.spin, rate = motion.spin_rate;
  const int n = ring_.mesh().nodes_per_sector(), elements = ring_.elements_per_sector();
  const Eigen::Matrix3Xd x = X_ + in_wheel_axes(motion.u);
  const Eigen::Matrix3Xd v = in_wheel_axes(motion.v), a = in_wheel_axes(motion.a);
  Forces sum{Eigen::Matrix3Xd::Zero(3, x.cols()), {}, Eigen::Vector3d::Zero()};
  // The elements of all sectors of one width have the same inertia: one product serves them all.
  Eigen::MatrixXd moved, f;   // [sectors and directions x nodes of a, x, v], [the same x nodes]
  Eigen::MatrixXd by(24, 8);  // inertia as seen by a, x and v
  for (int width = 0; width < ring_.widths(); ++width) {
    const std::vector<int>& sectors = sectors_[width];
    moved.resize(3 * std::ssize(sectors), 24);
    f.resize(moved.rows(), 8);
    for (int e = 0; e < elements; ++e) {
      for (std::size_t k = 0; k < sectors.size(); ++k) {
        const std::array<int, 8> nodes = nodes_of(ring_, sectors[k], ring_.mesh().elements[e]);
        for (int node = 0; node < 8; ++node) {
          const auto row = static_cast<Eigen::Index>(3 * k);
          moved.col(node).segment<3>(row) = a.col(nodes[node]);
          moved.col(8 + node).segment<3>(row) = x.col(nodes[node]);
          moved.col(16 + node).segment<3>(row) = v.col(nodes[node]);
        }
      }
      // Row vectors: f = m u of each direction is u m^T.
      const Scalars& of = of_width_[width][e];
      by << of.M, rate * of.G.transpose() - (spin * spin) * of.W, spin * (of.G.transpose() - of.G);
      numerics::add_product<double>(1.0, moved, by, 0.0, f);
      for (std::size_t k = 0; k < sectors.size(); ++k) {
        const std::array<int, 8> nodes = nodes_of(ring_, sectors[k], ring_.mesh().elements[e]);
        for (int node = 0; node < 8; ++node)
          sum.at_nodes.col(nodes[node]) += f.col(node).segment<3>(static_cast<Eigen::Index>(3 * k));
      }
    }
  }
  sum.force = sum.at_nodes.rowwise().sum();
  for (Eigen::Index k = 0; k < x.cols(); ++k) sum.moment += x.col(k).cross(sum.at_nodes.col(k));
  for (int s = 0; s < ring_.sectors(); ++s)
    sum.at_nodes.middleCols(s * n, n) =
        (frames_[s].transpose() * sum.at_nodes.middleCols(s * n, n)).eval();
  return sum;
}

double MovingInertia::twice_kinetic(const Eigen::Matrix3Xd& v) const {
  double sum = 0.0;
  const Eigen::Matrix3Xd moving = in_wheel_axes(v);
  for (int s = 0; s < ring_.sectors(); ++s) {
    const std::vector<Scalars>& known = of_width_[ring_.width(s)];
    for (int e = 0; e < ring_.elements_per_sector(); ++e) {
      const Matrix38 at = gathered(moving, nodes_of(ring_, s, ring_.mesh().elements[e]));
      sum += at.cwiseProduct(at * known[e].M).sum();
    }
  }
  return sum;
}

}  // namespace latsch::fe_tire
