// SPDX-License-Identifier: Apache-2.0
// The arithmetic of a step (16), (17) over all nodes, four unknowns each.
#pragma once

#include "models/ring_tire/belt/sidewall.h"

namespace latsch::ring_tire {

/// Computes B' m B a of belt_curve.h; m is the mass of a knot's unknowns.
void at_knots_and_back(const Eigen::Vector4d& m, const NodeValues& a, NodeValues& to);

/// Computes v1, a1 of (16) at q1, where v and a are the predicted velocities and the accelerations
/// before.
void follow(const StepRule& rule,
            const NodeValues& q1,
            const NodeValues& predicted,
            const NodeValues& v,
            const NodeValues& a,
            NodeValues& v1,
            NodeValues& a1);

/// Computes (1 - θ) f1 + θ f0 - M a1 and returns its largest entry; NaN if an entry is NaN.
double find_residual(double theta,
                     const NodeValues& f1,
                     const NodeValues& f0,
                     const NodeValues& inertia,
                     NodeValues& residual);

}  // namespace latsch::ring_tire
