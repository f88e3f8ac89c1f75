// SPDX-License-Identifier: Apache-2.0
// The ledger of the files of a record (measurement/ledger.h): built while the record is read.
#pragma once

#include <string>
#include <vector>

#include "correlation/laboratory/lab_record.h"
#include "formats/tables/lab_table.h"
#include "measurement/ledger.h"

namespace latsch::correlation {

/// The rows of a file: what each column became in the record, or why it is left out.
Ledger ledger_of(const formats::LabTable& table, const LabRecord& record);

/// A channel of the record is used by somebody.
void note_use(LabRecord& record, const std::string& channel, const std::string& by);

/// Says for every row what the convention makes of it: its sign, or that it is not turned. Where no
/// axes are stated and the file has channels that depend on them, iso is noted as assumed.
void note_axes(LabRecord& record, AxisConvention axes, bool are_stated);

/// Adds to the ledgers the doubts about signs and ranges (measurement/meaning/channel_checks.h) and
/// those about two columns for one channel. `is_stated`: by a [measurement.NAME], which is where to
/// go on.
void check_channels(LabRecord& record, bool axes_are_stated, bool is_stated);

/// `columns "FZ" and "Normal load" both are Fz`, and how to go on; empty where it is one column.
std::string ambiguity(const LabRecord& record, const std::string& channel);

}  // namespace latsch::correlation
