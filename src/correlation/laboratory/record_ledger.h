// SPDX-License-Identifier: Apache-2.0
// Builds the ledger of the files of a record (measurement/ledger.h) while the record is read.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "correlation/laboratory/lab_record.h"
#include "formats/tables/lab_table.h"
#include "measurement/ledger.h"

namespace latsch::correlation {

/// Returns the rows of a file: what each column became in the record, or why it was left out.
Ledger ledger_of(const formats::LabTable& table, const LabRecord& record);

/// Notes that a channel of the record is used by `by`.
void note_use(LabRecord& record, const std::string& channel, const std::string& by);

/// Notes in every row how the convention affects it: its sign, or that it is not turned. If no axes
/// are stated and the file has channels that depend on them, iso is noted as assumed.
void note_axes(LabRecord& record, AxisConvention axes, bool are_stated);

/// Adds doubts about signs and ranges (measurement/meaning/channel_checks.h) and about two columns
/// for one channel to the ledgers. `stated_axes` are those from which the record was turned, if the
/// user states any. `is_stated` is true if there is a [measurement.NAME], to which
/// the advice then refers.
void check_channels(LabRecord& record, std::optional<AxisConvention> stated_axes, bool is_stated);

/// Returns a doubt for every suspect number among the selected samples: its column, its rows and
/// how to leave it out. If the number is certainly no measured value, the doubt is an error, which
/// counts if something uses the channel. `table` is the name of the [measurement.NAME], or empty.
/// `selected` lists the channels by which the user selected samples; the user has probably looked
/// at these. `was_filtered` is true if a low-pass filter has spread the number over its neighbors.
std::vector<LedgerDoubt> suspect_numbers(const LabRecord& record,
                                         const std::string& table,
                                         const std::vector<std::string>& selected,
                                         bool was_filtered);

/// Returns `columns "FZ" and "Normal load" both are Fz` with advice; empty if only one column
/// claims the channel.
std::string ambiguity(const LabRecord& record, const std::string& channel);

}  // namespace latsch::correlation
