// SPDX-License-Identifier: Apache-2.0
// The samples of a measurement on their way from the files to what counts: our names, SI, gaps NaN.
// Steps change them and say in words what they did; measurement.h has their order.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "correlation/laboratory/selection.h"
#include "formats/tables/table_column.h"
#include "measurement/axes.h"
#include "measurement/channels.h"
#include "measurement/ledger.h"

namespace latsch::correlation {

/// A column of a file: its name, its unit, and the sign its values are taken with.
struct StatedColumn {
  std::string column, unit;
  double sign = 1.0;

  bool operator==(const StatedColumn&) const = default;
};

struct LabRecord {
  std::vector<Channel> channels;
  std::vector<Place> places;                            // of each sample
  std::vector<double> numbers;                          // of each sample, from 1 over all files
  Place header;                                         // of the first file
  std::map<std::string, StatedColumn> written;          // how that has a channel
  std::map<std::string, StatedColumn> stated;           // the table `columns` of the study
  std::map<std::string, formats::TableColumn> sources;  // how its file states a channel
  std::map<std::string, std::string> left_out;          // columns that are no channels, and why
  std::map<std::string, AxisFrame>
      turned_from;              // of channels that stand in another frame than there
  std::vector<Ledger> ledgers;  // of each file
  std::map<std::string, std::vector<std::string>> ambiguous;  // further columns of a channel

  std::size_t samples() const { return places.size(); }
  std::vector<std::string> names() const;
  /// nullptr where there is none; a name may leave out the frame.
  Channel* find(const std::string& name);
  const Channel* find(const std::string& name) const;
  /// Empty without a channel of time.
  std::vector<double> time() const;
  Channels table() const;
};

/// Files one after the other; channels that one of them lacks are left out. `columns`: our name ->
/// theirs.
LabRecord join_files(const std::vector<std::filesystem::path>& files,
                     const std::map<std::string, StatedColumn>& columns,
                     std::vector<std::string>& words);

/// Into iso.
void turn_axes(LabRecord& record, AxisConvention axes);
/// The conventions a record, not turned yet, may be in: those that have its loads upward and its
/// side force against the slip angle. All of them where it holds neither.
std::vector<std::string> conventions_that_fit(const LabRecord& record);

/// The channel less its mean over the samples of `window`. False where these are none.
bool take_zero(LabRecord& record, Channel& channel, const Window& window, std::string& words);

/// All channels but the time. Gaps, and stretches too short for the filter, stay as they are: these
/// are left out. Throws InputError at `place` where there is no time or no such frequency.
std::string low_pass(LabRecord& record, double frequency, const Place& place);

/// The samples of a mask.
void keep(LabRecord& record, const std::vector<bool>& kept);

/// The unit in which people read what is in an SI unit: "deg" for "rad".
std::string read_unit(const std::string& unit);
/// "from 2 to 5 N", in that unit.
std::string range_in_words(const Channel& channel);

}  // namespace latsch::correlation
