// SPDX-License-Identifier: Apache-2.0
// Finds statements that remove a contradiction between the signs of a record: other axes, or one
// quantity with the opposite sign. Every statement is tried on the record, and only those that
// leave no contradiction are advised. There may be several: a record in sae axes whose loads are
// written as positive is the mirror image of one in iso axes whose inclination has the opposite
// sign. If the sign of one lateral column is changed, the mirror image is named as well: the
// signs of all other lateral columns are changed instead.
#pragma once

#include <string>
#include <vector>

#include "correlation/laboratory/lab_record.h"

namespace latsch::correlation {

/// Returns statements of a [measurement.NAME] with which the signs agree, the shortest ones first:
/// `axes = "sae"`, `columns = {gamma = "-IA"}`, `axes = "sae"` with `columns = {Fz = "-FZ"}`. If a
/// table has several wheels, the sign of a quantity is changed for all of them. The signs of two
/// quantities are changed only if no other statement helps. Other axes are tried only if
/// none are stated. The list is empty if the signs already agree or if no statement helps.
std::vector<std::string> signs_that_agree(const LabRecord& record, bool axes_are_stated);

/// Returns the conventions in which no signs of channels contradict each other. The channels are as
/// read, without a conversion of axes.
std::vector<AxisConvention> axes_that_agree(const Channels& channels);

/// Returns the table `columns` that changes the sign of a channel.
std::string turned(const LabRecord& record, const std::string& channel);

}  // namespace latsch::correlation
