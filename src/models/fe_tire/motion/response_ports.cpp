// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/motion/response_ports.h"

#include <Eigen/Geometry>

#include "models/fe_tire/contact/contact.h"
#include "models/fe_tire/element/hex8.h"

namespace latsch::fe_tire {
namespace {

using Of = ResponsePort::Of;

/// Factors of a vector's components in the half turn about the vertical through the wheel center.
const Eigen::Vector3d kHalfTurn(-1.0, -1.0, 1.0);

/// A port's axis in the wheel frame.
struct PosedPort {
  Of of;
  int node;
  Eigen::Vector3d axis;
  bool turns;

  /// Returns the motion of a place x of the wheel or the ground for a unit of the port.
  Eigen::Vector3d motion(const Eigen::Vector3d& x) const {
    return turns ? Eigen::Vector3d(axis.cross(x)) : axis;
  }
};

std::vector<PosedPort> posed(const std::vector<ResponsePort>& ports, const TireState& state) {
  // Axes level with the ground, which do not turn with it.
  const PosedGround level(state.ground, {state.pose.height, 0.0, 0.0, state.pose.camber, 0.0});
  std::vector<PosedPort> result;
  for (const ResponsePort& port : ports)
    result.push_back({port.of, port.node, level.to_wheel(port.axis), port.turns});
  return result;
}

/// A point in contact, of the whole ring: place, force and stiffness in the wheel frame.
struct Contact {
  Eigen::Vector3d x, c;
  Eigen::Matrix3d k;

  Contact turned() const {
    return {kHalfTurn.cwiseProduct(x),
            kHalfTurn.cwiseProduct(c),
            kHalfTurn.asDiagonal() * k * kHalfTurn.asDiagonal()};
  }
  /// Returns the force on the tire at this point if the ground moves by a unit of the port: g.
  Eigen::Vector3d by_ground(const PosedPort& port) const {
    Eigen::Vector3d force = k * port.motion(x);
    if (port.turns) force += port.axis.cross(c);
    return force;
  }
};

/// Sums up the loads of ports.
class LoadSum {
 public:
  LoadSum(const std::vector<NumberedMotions>& motions, const std::vector<PosedPort>& ports)
      : motions_(motions), ports_(ports) {
    const auto count = std::ssize(ports);
    for (const NumberedMotions& one : motions)
      loads.still.push_back(Eigen::MatrixXd::Zero(one.unknowns->size(), count));
    loads.inertial = loads.still;
    loads.sign.setOnes(count);
    for (Eigen::Index i = 0; i < count; ++i)
      if (ports[i].of == Of::ground) loads.sign[i] = -1.0;
    loads.direct.setZero(count, count);
    loads.direct_inertial = loads.direct;
  }

  void add_contact(int point, const Contact& at);
  void add_inertia(const RingElements& elements, const Eigen::Matrix3Xd& x);
  void add_points(const Mesh& mesh, const Eigen::Matrix3Xd& x);

  PortLoads loads;

 private:
  void add_direct(const Contact& at);
  void add_at_node(const Mesh& mesh,
                   int node,
                   const Eigen::Vector3d& force,
                   Eigen::Index port,
                   std::vector<Eigen::MatrixXd>& sum) const;

  const std::vector<NumberedMotions>& motions_;
  const std::vector<PosedPort>& ports_;
};

/// Adds the ground's action at a point of the assembled part of the ring, and at its image.
void LoadSum::add_contact(int point, const Contact& at) {
  const bool is_halved = motions_.front().unknowns->multiplicity() > 1.0;
  add_direct(at);
  if (is_halved) add_direct(at.turned());
  for (std::size_t k = 0; k < motions_.size(); ++k) {
    const TreadSurface& tread = *motions_[k].tread;
    const TreadSurface::Point& of = tread.points()[point];
    for (std::size_t i = 0; i < ports_.size(); ++i) {
      if (ports_[i].of == Of::point) continue;
      Eigen::Vector3d force = at.by_ground(ports_[i]);
      if (is_halved)
        force = 0.5 * (force + motions_[k].parity *
                                   kHalfTurn.cwiseProduct(at.turned().by_ground(ports_[i])));
      // The wheel's motion is that of the ground, reversed.
      if (ports_[i].of == Of::wheel) force = -force;
      for (int w = 0; w < of.weights; ++w) {
        const TreadSurface::Weight& weight = tread.weights(of)[w];
        const TreadSurface::Place& place = tread.places()[weight.place];
        if (place.node < 0) continue;
        loads.still[k]
            .col(static_cast<Eigen::Index>(i))
            .segment<3>(3 * tread.block_rows()[place.node]) +=
            weight.w * (place.T.transpose() * force);
      }
    }
  }
}

void LoadSum::add_direct(const Contact& at) {
  for (std::size_t i = 0; i < ports_.size(); ++i) {
    if (ports_[i].of == Of::point) continue;
    for (std::size_t j = 0; j < ports_.size(); ++j) {
      const PosedPort &out = ports_[i], &in = ports_[j];
      if (in.of == Of::point) continue;
      double force;
      if (in.of == Of::ground) {
        force = out.motion(at.x).dot(at.by_ground(in));
      } else {
        force = -out.motion(at.x).dot(at.k * in.motion(at.x));
        // The force of the ground acts at another place of a tire that turns.
        if (out.turns && in.turns) force += out.axis.dot(in.motion(at.x).cross(at.c));
      }
      loads.direct(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) += force;
    }
  }
}

/// Adds a force at a node, given in the wheel frame.
void LoadSum::add_at_node(const Mesh& mesh,
                          int node,
                          const Eigen::Vector3d& force,
                          Eigen::Index port,
                          std::vector<Eigen::MatrixXd>& sum) const {
  const int n = mesh.nodes_per_sector(), plane = node / n;
  const Eigen::Vector3d in_sector = mesh.frame(plane).transpose() * force;
  for (std::size_t k = 0; k < motions_.size(); ++k) {
    const RingUnknowns& unknowns = *motions_[k].unknowns;
    const auto at = unknowns.of_node(plane, node % n);
    if (at.first < 0) continue;
    sum[k].col(port).segment<3>(at.first) +=
        at.sign.cwiseProduct(in_sector) / unknowns.multiplicity();
  }
}

/// Adds the inertia of a tire that follows the wheel as a rigid body. `x`: positions of all nodes
/// in the wheel frame.
void LoadSum::add_inertia(const RingElements& elements, const Eigen::Matrix3Xd& x) {
  const Ring& ring = elements.ring();
  const Mesh& mesh = ring.mesh();
  const int n = mesh.nodes_per_sector(), S = ring.sectors();
  for (std::size_t i = 0; i < ports_.size(); ++i) {
    if (ports_[i].of != Of::wheel) continue;
    Eigen::Matrix3Xd T(3, x.cols()), MT = Eigen::Matrix3Xd::Zero(3, x.cols());
    for (Eigen::Index node = 0; node < x.cols(); ++node)
      T.col(node) = ports_[i].motion(x.col(node));
    for (int s = 0; s < S; ++s) {
      for (int e = 0; e < ring.elements_per_sector(); ++e) {
        const Element& element = mesh.elements[e];
        const Matrix8 m = mass(ring.shape(s, e), elements.materials(), element);
        for (int a = 0; a < 8; ++a) {
          const auto of = [&](int k) {
            return (s + element.node[k] / n) % S * n + element.node[k] % n;
          };
          for (int b = 0; b < 8; ++b) MT.col(of(a)) += m(a, b) * T.col(of(b));
        }
      }
    }
    const auto port = static_cast<Eigen::Index>(i);
    for (int node = 0; node < mesh.nodes(); ++node)
      add_at_node(mesh, node, MT.col(node), port, loads.inertial);
    for (std::size_t j = 0; j < ports_.size(); ++j) {
      if (ports_[j].of != Of::wheel) continue;
      for (Eigen::Index node = 0; node < x.cols(); ++node)
        loads.direct_inertial(static_cast<Eigen::Index>(j), port) +=
            ports_[j].motion(x.col(node)).dot(MT.col(node));
    }
  }
}

void LoadSum::add_points(const Mesh& mesh, const Eigen::Matrix3Xd& x) {
  for (std::size_t i = 0; i < ports_.size(); ++i) {
    if (ports_[i].of != Of::point) continue;
    const auto port = static_cast<Eigen::Index>(i);
    add_at_node(mesh, ports_[i].node, ports_[i].axis, port, loads.still);
    for (std::size_t j = 0; j < ports_.size(); ++j) {
      if (ports_[j].of != Of::wheel) continue;
      const double moved = ports_[i].axis.dot(ports_[j].motion(x.col(ports_[i].node)));
      loads.direct(port, static_cast<Eigen::Index>(j)) = moved;
      loads.direct(static_cast<Eigen::Index>(j), port) = moved;
    }
  }
}

}  // namespace

PortLoads port_loads(const Systems& all,
                     const RingElements& elements,
                     const TireState& state,
                     const std::vector<NumberedMotions>& motions,
                     const std::vector<ResponsePort>& ports) {
  const std::vector<PosedPort> in_wheel = posed(ports, state);
  LoadSum sum(motions, in_wheel);
  const Eigen::VectorXd unknowns = all.unknowns.compress(state.u);
  TreadContact contact(all.tread, state.ground);
  contact.start(state.pose, unknowns, state.anchors);
  const Eigen::Matrix3Xd points =
      all.tread.points_at(all.tread.positions(all.tread.displacements(unknowns)));
  // Points stick, but the force that they have is that of the state.
  const auto forces = contact.touches(all.tread.displacements(unknowns));
  const auto springs = contact.stuck(unknowns);
  for (std::size_t t = 0; t < springs.size(); ++t)
    sum.add_contact(springs[t].point,
                    {points.col(springs[t].point), forces[t].force, springs[t].stiffness});
  const Mesh& mesh = elements.ring().mesh();
  const int n = mesh.nodes_per_sector();
  Eigen::Matrix3Xd x(3, mesh.nodes());
  for (int s = 0; s < mesh.sectors; ++s)
    x.middleCols(s * n, n) = mesh.frame(s) * (mesh.X + state.u.middleCols(s * n, n));
  sum.add_inertia(elements, x);
  sum.add_points(mesh, x);
  return std::move(sum.loads);
}

}  // namespace latsch::fe_tire
