// SPDX-License-Identifier: Apache-2.0
// A rod between two joints that turn freely can spin about its own line without force or stiffness,
// so its static equilibrium is not unique and the tangent is singular. Only this spin is held, by
// an additional stiffness:
//   first joint, axes A with A e_3 along the rod:  rotational stiffness k e_3 e_3',  k = 1 N m/rad
// The rod otherwise spins freely, so its moment about the line is zero at rest. Hence k q_3 = 0,
// and the whole moment -A N' (k q_3 e_3) is zero, however far the rod turns across its line. The
// additional stiffness therefore does not affect the motion of a wheel: neither its forces nor,
// after elimination of the spin, its derivatives.
#pragma once

#include "models/multibody/mechanism.h"

namespace latsch::multibody {

/// Holds the spin of the rod between these joints if one of the joints is rigid and neither resists
/// a rotation about the line through both. The rotational stiffness is added to the rigid joint.
void hold_spin(Joint& inner, Joint& outer);

}  // namespace latsch::multibody
