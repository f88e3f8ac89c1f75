// SPDX-License-Identifier: Apache-2.0
// Ports of a linear tire about a state: where it is driven and observed, as loads on its nodes and
// as forces that these nodes exert.
//
// A tire moves by u = T q_w + v, with the wheel's motion q_w, which every node follows as a rigid
// body, T = d or e x (x - wheel center), and the motion v relative to the rim, which holds the
// bead. A rigid motion strains nothing, so that the wheel's motion loads v by the ground and by
// inertia:
//   Z(omega) v = p q_point + g (q_g - q_w) + omega^2 M T q_w,   g = k T + e x c
// (Z.2) p is a unit force on a point; q_g is a motion of the ground; k and c are the stiffness and
// the force of the ground at the points in contact, and e x c is what turns with a ground that
// turns. The ground's force on the tire changes by -g'v, and the tire's force on the rim follows
// from the tire's momentum, the mass of the bead included:
//   F_g = -g'v + T'(k T + e x c) q_g - (T'k T - (T x c)) q_w
//   F_h = F_g + p + omega^2 T'M (v + T q_w)                                                  (Z.3)
// which is the reaction K v - omega^2 M u at the held nodes, because elements and a pressure whose
// edges the rim holds have no net force. Moments are about the wheel center, which moves along. The
// force on the rim is that of the tire alone: the pressure on the rim itself does not change.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "models/fe_tire/analysis/fe_tire.h"
#include "models/fe_tire/analysis/fe_tire_impl.h"
#include "models/fe_tire/motion/response_port.h"

namespace latsch::fe_tire {

/// A numbering of unknowns, the motions that it represents (all, even or odd), and the surface of
/// the tread in it.
struct NumberedMotions {
  const RingUnknowns* unknowns;
  const TreadSurface* tread;
  double parity;  // 1: even or all; -1: odd
};

/// Ports in the numberings of the ring's motions. Vectors hold half of a load if half of the ring
/// represents all of it: the work of a load on the whole ring is `multiplicity` times theirs.
struct PortLoads {
  /// Loads of a unit at each port: still + omega^2 inertial, [unknowns x ports] for each numbering.
  std::vector<Eigen::MatrixXd> still, inertial;
  /// Share of a port's loads that its row of outputs has: -1 for the ground, whose force is that on
  /// the tire, else 1.
  Eigen::VectorXd sign;
  /// Outputs at a tire without motion v: direct + omega^2 direct_inertial, [outputs x inputs].
  Eigen::MatrixXd direct, direct_inertial;
};

/// Returns the loads of the ports about a state of the ring whose elements these are. `motions`:
/// numberings of all.unknowns and, if there are any, of odd motions.
PortLoads port_loads(const Systems& all,
                     const RingElements& elements,
                     const TireState& state,
                     const std::vector<NumberedMotions>& motions,
                     const std::vector<ResponsePort>& ports);

}  // namespace latsch::fe_tire
