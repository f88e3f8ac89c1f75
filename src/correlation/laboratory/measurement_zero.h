// SPDX-License-Identifier: Apache-2.0
// The step `zero` of a table [measurement.NAME]: it subtracts from channels their means over a
// time, or over the samples in which other channels lie within windows, as those of an unloaded
// wheel on a K&C rig.
#pragma once

#include <string>
#include <vector>

#include "base/document_node.h"
#include "correlation/laboratory/lab_record.h"

namespace latsch::correlation {

/// Returns the channel that a key of a table names. Throws InputError if there is none; the message
/// lists the channels of the record.
Channel& channel_of(const Node& table, const std::string& key, LabRecord& record);

/// Subtracts the means that the table `zero` of a measurement states. Adds a line to `words` for
/// each, and adds a doubt to the ledger if a mean is a large part of the measured values or comes
/// from few samples. Throws InputError for a window without samples and for a channel that does not
/// exist.
void read_zero(const Node& table, LabRecord& record, std::vector<std::string>& words);

}  // namespace latsch::correlation
