// SPDX-License-Identifier: Apache-2.0
// A compliant corner in another position of its wheel: its links moved it there as rigid links, its
// bushings are without load there, and a rigid bar replaces the spring at the length that it has
// there. A bushing's axes turn with its first body; those of a bushing on the chassis do not turn.
//
// So the compliance of this corner is the one about the position, without the effect of the loads
// that a car has there: bushings with curved characteristics are at the origin of their curves.
#pragma once

#include "base/result.h"
#include "models/suspension/suspension_reader.h"

namespace latsch::suspension {

/// Returns the corner at this travel of the wheel center and this travel of the rack, m. The corner
/// must have bushings. Loads act at the contact point of that position. A Failure names the link
/// that limits the motion.
Result<CompliantCorner> moved_corner(const SuspensionCorner& corner, double travel, double rack);

}  // namespace latsch::suspension
