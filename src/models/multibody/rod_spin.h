// SPDX-License-Identifier: Apache-2.0
// A rod between two joints that turn freely spins about its own line, which no force feels and no
// stiffness meets: statics have no solution there, or any. Its spin, and nothing else, is held:
//   first joint, axes A with A e_3 along the rod:  rotational stiffness k e_3 e_3',  k = 1 N m/rad
// As the rod spins freely otherwise, its moment about the line is zero at rest, hence k q_3 = 0 and
// the whole moment -A N' (k q_3 e_3) is zero, however far the rod turns across its line: a wheel's
// motion meets no stiffness of it, neither in forces nor, with the spin eliminated, in slopes.
#pragma once

#include "models/multibody/mechanism.h"

namespace latsch::multibody {

/// Holds the spin of a rod between these joints where one of them is rigid and neither resists a
/// turn about the line through both: at the rigid one.
void hold_spin(Joint& inner, Joint& outer);

}  // namespace latsch::multibody
