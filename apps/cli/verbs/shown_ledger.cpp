// SPDX-License-Identifier: Apache-2.0
// Implements the view of a ledger in `latsch show`: how each column of a file was interpreted.
#include <fmt/format.h>

#include "base/error.h"
#include "cli/console/ledgers.h"
#include "cli/verbs/shown_file.h"
#include "correlation/laboratory/measurement.h"

namespace latsch::cli {

void show_ledger(const Ledger& ledger,
                 bool with_users,
                 ShownFile& shown,
                 const std::vector<Ledger>& among) {
  const std::string file = name_among(ledger, among);
  ShownTable table{"Ledger of " + file, ledger_heads(), {}};
  if (!with_users) table.heads.back() = "known";
  for (const LedgerRow& row : ledger.rows) {
    auto cells = ledger_cells(row);
    if (!with_users && row.state == LedgerState::not_used)
      cells.back() = std::string(row.taken_as.empty() ? "no" : "yes") +
                     (row.remark.empty() ? "" : ": " + row.remark);
    table.rows.push_back(std::move(cells));
  }
  shown.tables.push_back(std::move(table));
  if (with_users) shown.facts.push_back(file + ": " + in_one_line(ledger));
  for (const LedgerDoubt& doubt : ledger.doubts)
    shown.facts.push_back("? " + (doubt.place.line > 0 ? doubt.place.text() + ": " : "") +
                          doubt.sentence);
  shown.ledgers.push_back(ledger);
}

void show_ledger_of(const std::filesystem::path& file,
                    std::optional<AxisConvention> axes,
                    ShownFile& shown) {
  try {
    show_ledger(correlation::read_measured_file(file, axes).ledger, false, shown);
  } catch (const InputError& error) {
    shown.facts.push_back(std::string("no recording: ") + error.what());
  }
}

}  // namespace latsch::cli
