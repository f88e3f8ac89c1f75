// SPDX-License-Identifier: Apache-2.0
// The content of a file as `latsch show` presents it: facts, tables, plots.
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

/// Reads a file by its extension: .tdx, .tydex, .csv, .mat, .tir, .bus, .crg, .rdf, .toml,
/// .inp, and those of recorder_endings().
/// `axes` is the sign convention of the file; channels are returned in iso. Throws InputError.
ShownFile shown_file(const std::filesystem::path& file, AxisConvention axes);

/// Returns the view of every [measurement.NAME] of a study, or of the measurement `only` if it is
/// not empty (shown_measurement.cpp).
ShownFile shown_measurements(const std::filesystem::path& study, const std::string& only = "");
/// Adds a ledger to the view: a table of how each column was interpreted, with its doubts as facts.
/// `with_users` is true for a study, which knows the users of each column. The title contains the
/// folder of the file if another ledger `among` has a file of the same name.
void show_ledger(const Ledger& ledger,
                 bool with_users,
                 ShownFile& shown,
                 const std::vector<Ledger>& among = {});
/// Adds the ledger of a single table or recording with its stated axes. If the file is neither, a
/// fact of the view says so. Defined in shown_ledger.cpp.
void show_ledger_of(const std::filesystem::path& file,
                    std::optional<AxisConvention> axes,
                    ShownFile& shown);
ShownFile shown_tire(const std::filesystem::path& tir);
ShownFile shown_bushing(const std::filesystem::path& bus);
ShownFile shown_road(const std::filesystem::path& road);

/// Adds a table and plots of the channels. The abscissa is the time if there is one; else the first
/// channel if `over_first`, or the sample number.
void show_channels(const Channels& channels, bool over_first, ShownFile& shown);

/// Returns name, unit, number of samples and of gaps, smallest value, mean and largest value of a
/// channel.
std::vector<std::string> statistics(const Channel& channel);

}  // namespace latsch::cli
