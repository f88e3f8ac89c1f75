// SPDX-License-Identifier: Apache-2.0
// The samples of a recording while they are read and processed, with Latsch's names, in SI units,
// and with NaN for gaps. Each processing step changes the samples and describes in words what it
// did; measurement.h has the order of the steps.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
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

/// Column of a file: its name, its unit, and the sign applied to its values.
struct StatedColumn {
  std::string column, unit;
  double sign = 1.0;
  Place place = {};  // the statement in the study; empty if no study states the column

  bool operator==(const StatedColumn&) const = default;
};

/// True for DSTGRWHC in any case, which is the "distance ground - wheel center" of a TYDEX file:
/// the height of the center, which is less than the loaded radius of an inclined wheel.
bool is_height_of_center(const std::string& column);

/// Numbers in a channel that are probably not measured values
/// (measurement/meaning/filler_numbers.h).
struct SuspectSamples {
  std::string channel;          // Latsch's name
  std::string number;           // with the unit in the file: "-9999 N"
  std::string reason;           // reason in words, which follows the number in a message
  std::vector<double> samples;  // their numbers, from 1 over all files
  bool is_certain = false;
};

struct LabRecord {
  std::vector<Channel> channels;
  std::vector<Place> places;                    // one for each sample
  std::vector<double> numbers;                  // their numbers, from 1 over all files
  Place header;                                 // the head of the first file
  std::map<std::string, StatedColumn> written;  // for each channel, the column as the file names it
  std::map<std::string, StatedColumn> stated;   // the table `columns` of the study
  /// for each channel, the column as its file states it
  std::map<std::string, formats::TableColumn> sources;
  /// columns that did not become channels, with the reason
  std::map<std::string, std::string> left_out;
  std::map<std::string, AxisFrame> turned_from;  // for each converted channel, its original frame
  std::vector<Ledger> ledgers;                   // one for each file
  /// For each channel, further columns that claim the same channel.
  std::map<std::string, std::vector<std::string>> ambiguous;
  std::vector<SuspectSamples> suspects;
  std::vector<std::string> structs;  // structs of the first file, if none of them was chosen
  std::string part_word = "struct";  // "group" if those are groups of different rates

  std::size_t samples() const { return places.size(); }
  std::vector<std::string> names() const;
  /// Returns nullptr if there is none. The name may leave out the frame.
  Channel* find(const std::string& name);
  const Channel* find(const std::string& name) const;
  /// Returns an empty vector if there is no channel of time.
  std::vector<double> time() const;
  Channels table() const;
};

/// Joins files one after the other; channels that one of them lacks are omitted. `columns` maps
/// Latsch's names of channels to columns of the files. `part` is the struct or group of the files
/// that contains the channels, or empty; a step of time `resampled` above 0, in s, joins groups.
LabRecord join_files(const std::vector<std::filesystem::path>& files,
                     const std::map<std::string, StatedColumn>& columns,
                     const std::string& part,
                     double resampled,
                     std::vector<std::string>& words);

/// Returns why channels cannot be in these axes, to follow their name: those of Adams define no
/// slip angle. Returns an empty text if they can.
std::string fault_of_axes(const Channels& channels, AxisConvention axes);
/// Turns the channels into iso axes. Throws InputError at the header for axes that do not define
/// every channel.
void turn_axes(LabRecord& record, AxisConvention axes);
/// Returns the conventions of axes that fit a record in its original axes: those in which its loads
/// point upward and its side force opposes the slip angle. Returns all conventions if the record
/// has neither.
std::vector<std::string> conventions_that_fit(const LabRecord& record);

/// The mean that was subtracted from a channel, in its SI unit, and the number of its samples.
struct TakenZero {
  double mean = 0.0;
  std::size_t samples = 0;
};
/// Subtracts from a channel its mean over the samples of a mask. Returns nothing if the mask has no
/// samples or all of them are gaps.
std::optional<TakenZero> take_zero(Channel& channel, const std::vector<bool>& mask);

/// Applies a low-pass filter to all channels except time. Gaps, and parts of a channel too short
/// for the filter, are not filtered. Throws InputError at `place` if there is no channel of time or
/// if the frequency is impossible.
std::string low_pass(LabRecord& record, double frequency, const Place& place);

/// Keeps only the samples that a mask selects.
void keep(LabRecord& record, const std::vector<bool>& kept);

/// Returns the unit in which people expect a quantity with this SI unit: "deg" for "rad".
std::string read_unit(const std::string& unit);
/// Returns the range of a channel in that unit: "from 2 to 5 N".
std::string range_in_words(const Channel& channel);

}  // namespace latsch::correlation
