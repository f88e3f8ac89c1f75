// SPDX-License-Identifier: Apache-2.0
// Finds statements that remove a contradiction between the signs of a record: other axes, or one
// quantity with the opposite sign. Every statement is tried on the record, and only those that
// leave no contradiction are advised. There may be several: a record in sae axes whose loads are
// written as positive is the mirror image of one in iso axes whose inclination has the opposite
// sign. If the sign of one lateral column is changed, the mirror image is named as well: the
// signs of all other lateral columns are changed instead.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "correlation/laboratory/lab_record.h"

namespace latsch::correlation {

/// Returns statements of a [measurement.NAME] with which the signs agree, the shortest ones first:
/// `axes = "sae"`, `columns = {gamma = "-IA"}`, `axes = "sae"` with `columns = {Fz = "-FZ"}`. If a
/// table has several wheels, the sign of a quantity is changed for all of them. The signs of two
/// quantities are changed only if no other statement helps. The list is empty if the signs already
/// agree or if no statement helps.
///
/// `stated` are the axes that the study states, from which the record was turned to iso. Statements
/// with other axes then say that these take the place of the stated ones; there are none if a force
/// was converted to another frame, because such a record cannot be turned back. Where a record and
/// its mirror image agree, each statement says how a person sees at the rig that it is right.
std::vector<std::string> signs_that_agree(const LabRecord& record,
                                          std::optional<AxisConvention> stated);

/// Returns the conventions in which no signs of channels contradict each other. The channels are as
/// read, without a conversion of axes.
std::vector<AxisConvention> axes_that_agree(const Channels& channels);

/// Returns the table `columns` that changes the sign of a channel.
std::string turned(const LabRecord& record, const std::string& channel);

}  // namespace latsch::correlation
