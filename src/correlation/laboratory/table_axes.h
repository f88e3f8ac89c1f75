// SPDX-License-Identifier: Apache-2.0
// Finds the axes in which a K&C table may be if its study states none.
//
// A table that contradicts iso axes is doubted where it is read (record_ledger.h). Here every other
// convention is tried on the table: if the signs agree in it as well as in iso and it would change
// a channel that the study uses, then the data do not tell the axes, and the user has to state
// them. Whether they tell depends on the channels and the rows of the table: four rows with eight
// loads have no slopes, and displacements without loads have no law.
#pragma once

#include <string>
#include <vector>

#include "correlation/laboratory/measurement.h"

namespace latsch::correlation {

/// Returns the statements after which a K&C table has the signs of the given side, +1 for left:
/// axes, if none are stated, and the table `columns` with toe and camber turned.
std::vector<std::string> statements_for_side(const Measurement& measurement,
                                             bool axes_are_stated,
                                             int side);

/// Returns the names of iso and of the other conventions, in quotes, in which the signs of a table
/// without stated axes agree alike although the used channels differ. `side` is that of the model's
/// wheel, +1 for left, 0 if it has none. The list is empty if iso is the only one, if the signs
/// contradict iso, and for a table that does not come from a K&C rig. All users of the
/// measurement have to be read before.
std::vector<std::string> axes_alike(const Measurement& measurement, int side);

}  // namespace latsch::correlation
