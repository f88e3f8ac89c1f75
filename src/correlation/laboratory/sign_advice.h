// SPDX-License-Identifier: Apache-2.0
// Finds what to state about a record whose signs contradict each other: other axes, or one column
// with the other sign. Every statement is tried on the record, and only those are advised that
// leave no contradiction. Several may: a record in sae axes whose loads are written as positive is
// the mirror image of one in iso axes whose inclination has the other sign. Beside one lateral
// column that is turned, its mirror image is named: all the others turned.
#pragma once

#include <string>
#include <vector>

#include "correlation/laboratory/lab_record.h"

namespace latsch::correlation {

/// Returns statements of a [measurement.NAME] with which the signs agree, the shortest ones first:
/// `axes = "sae"`, `columns = {gamma = "-IA"}`, `axes = "sae"` with `columns = {Fz = "-FZ"}`. Two
/// columns are turned only if no other statement helps. Axes are tried only if none are stated.
/// Empty if the signs agree as they are or no statement helps.
std::vector<std::string> signs_that_agree(const LabRecord& record, bool axes_are_stated);

/// Returns the table `columns` with which a channel has the other sign.
std::string turned(const LabRecord& record, const std::string& channel);

}  // namespace latsch::correlation
