// SPDX-License-Identifier: Apache-2.0
// The content of a file for a person to look at: facts, tables, plots.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "experiment/language/test.h"
#include "measurement/axes.h"
#include "measurement/channels.h"
#include "measurement/ledger.h"
#include "report/line_plot.h"

namespace latsch::cli {

struct ShownTable {
  std::string title;
  std::vector<std::string> heads;
  std::vector<std::vector<std::string>> rows;
};

struct ShownFile {
  std::string kind;  // "TYDEX 1.3"
  std::vector<std::string> facts;
  std::vector<ShownTable> tables;
  std::vector<Ledger> ledgers;
  std::vector<experiment::Test::Picture> pictures;
  std::vector<report::LinePlot> plots;
};

/// Decides by the extension: .tdx, .tydex, .csv, .mat, .tir, .bus, .crg, .rdf, .toml, .inp.
/// Channels are returned in iso, converted from the signs `axes` of the file. Throws InputError.
ShownFile shown_file(const std::filesystem::path& file, AxisConvention axes);

/// Shows every [measurement.NAME] of a study, or `only` one of them. See shown_measurement.cpp.
ShownFile shown_measurements(const std::filesystem::path& study, const std::string& only = "");
/// Adds the ledger of what was read: a table, with its doubts as facts. `with_users` is true for a
/// study, where the users of a column are known. Its file has its folder in the title if another
/// one `among` these ledgers has the same name.
void show_ledger(const Ledger& ledger,
                 bool with_users,
                 ShownFile& shown,
                 const std::vector<Ledger>& among = {});
/// Adds the ledger of a table or recording alone, with its stated axes; if the file is neither, a
/// fact says so. See shown_ledger.cpp.
void show_ledger_of(const std::filesystem::path& file,
                    std::optional<AxisConvention> axes,
                    ShownFile& shown);
ShownFile shown_tire(const std::filesystem::path& tir);
ShownFile shown_bushing(const std::filesystem::path& bus);
ShownFile shown_road(const std::filesystem::path& road);

/// Shows channels as table and plots, over the time if there is one; else over the first channel if
/// `over_first`, or over the sample number.
void show_channels(const Channels& channels, bool over_first, ShownFile& shown);

/// Returns name, unit, samples, gaps, smallest, mean, largest.
std::vector<std::string> statistics(const Channel& channel);

}  // namespace latsch::cli
