// SPDX-License-Identifier: Apache-2.0
// What a laboratory recorded, and what of it counts. An experiment names it as its measurement, a
// test takes its conditions from it; what is not stated is not done.
//
//   [measurement.cornering]
//   file = "run4.dat"               # .csv .txt .dat .mat .tdx .tda .tdb; or files = ["a.dat", ...]
//   axes = "sae"                    # signs of the file: iso (unless given), adapted_sae, sae
//   frame = "W"                     # of forces and moments whose names do not say it
//   columns = {Fz = "LOAD", p = "P_kPa [kPa]"}  # our name = the file's column, with a unit where
//                                               # the file states none; "-LOAD" changes the sign
//   zero = {channels = ["Fy"], time = "0 s .. 2 s"}  # less their means of that time
//   in_frame = "W"                  # turned into these axes from those of frame or of the names,
//                                   # by the record's gamma and loaded_radius (frame_conversion.h)
//   low_pass = "20 Hz"              # Butterworth of order 2, forward and backward: no delay, 6 dB
//                                   # down there; stretches between jumps of time by themselves
//   shift = "-12 ms"                # added to the time: onto that of the test
//   sweep = {alpha = "rising"}      # or "falling"
//   every = 5                       # thinned, last of all: every fifth of the samples left
//
//   [measurement.cornering.select]  # samples left: all of these hold
//   time = "30 s .."                # after the warm-up
//   Fz = ["1050 +- 100 N", "1610 +- 100 N"]  # one of several windows
//   gamma = "-0.3 .. 0.3 deg"
//   tread_center = "50 degC .. 80 degC"
//
//   [measurement.cornering.noise]   # of experiments that state none
//   Fy = "20 N"
//
//   [experiment.side_force]
//   kind = "curve"
//   y = "steady/Fy"
//   measurement = "cornering"       # or a file, of which nothing needs to be said
//
// The steps are taken in the order above. Channels have our names and SI units, in iso axes,
// whatever the file calls them: the vocabulary knows SA, SLIPANGL, slip angle and others as alpha
// (measurement/meaning/channel_words.h). Signs and ranges of what is left are checked, and every
// file has a ledger of what its columns were taken for (measurement/ledger.h).
//
// Forces and moments are Fx Fy Fz Mx My Mz, of TYDEX with the frame behind it: FyW. Gaps matter
// only in channels that something needs.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/document.h"
#include "correlation/laboratory/channel_names.h"
#include "correlation/laboratory/lab_record.h"
#include "correlation/laboratory/measurement_noise.h"
#include "measurement/channels.h"

namespace latsch::correlation {

class Measurement {
 public:
  struct Told {
    std::string name;       // "cornering"; of a file about which nothing is said its own
    Place place;            // of its table, or the header of the file
    bool is_stated = true;  // by a [measurement.NAME]
    std::vector<std::filesystem::path> files;
    std::string frame;
    std::vector<std::string> words;    // what was read and what each step left, a line each
    std::vector<std::string> one_way;  // steps that cannot be undone: "low_pass", ...
    std::map<std::string, MeasurementNoise> noise;
    std::map<std::string, std::string> left_out;          // channels that are none, and why
    std::map<std::string, StatedColumn> written;          // how the file has a channel
    std::map<std::string, StatedColumn> stated;           // the table `columns`
    std::map<std::string, formats::TableColumn> sources;  // how its file states a channel
    std::map<std::string, AxisFrame> turned_from;  // its frame there, where in_frame has turned it
    AxisConvention axes = AxisConvention::iso;
    std::shared_ptr<std::vector<Ledger>> ledgers;  // of each file
    std::map<std::string, std::string> ambiguous;  // channels that two columns are, in words
    Channels recorded;                             // as read, in our names and axes
    Channels channels;                             // what counts
    std::vector<Place> places;                     // of its samples
    std::vector<double> numbers;                   // of its samples, from 1
  };
  explicit Measurement(Told told) : told_(std::move(told)) {}

  const std::string& name() const { return told_.name; }
  const Place& place() const { return told_.place; }
  const Place& place(std::size_t sample) const { return told_.places[sample]; }
  bool is_stated() const { return told_.is_stated; }
  const std::vector<std::filesystem::path>& files() const { return told_.files; }
  const std::vector<std::string>& words() const { return told_.words; }
  const std::vector<std::string>& one_way() const { return told_.one_way; }
  AxisConvention axes() const { return told_.axes; }
  const Channels& recorded() const { return told_.recorded; }
  const Channels& channels() const { return told_.channels; }
  const std::vector<double>& numbers() const { return told_.numbers; }
  std::size_t samples() const { return told_.places.size(); }

  bool has(const std::string& channel) const;
  /// A channel in the SI unit `unit`. Throws InputError naming the place: there is none (the
  /// nearest names), another dimension, gaps (how many, where).
  const std::vector<double>& values(const std::string& channel, const std::string& unit) const;
  /// SI, of a channel that is there.
  const std::string& unit(const std::string& channel) const;
  /// Of a force or moment, where its name or the table says it; else empty. "W", "H", "C".
  std::string frame(const std::string& channel) const;
  /// As its file calls it.
  std::string name_of(const std::string& channel) const;
  /// Its column and unit in the file.
  const StatedColumn& written(const std::string& channel) const;
  /// Forces and moments that in_frame has turned, and the frame they have in the file.
  const std::map<std::string, AxisFrame>& turned_from() const { return told_.turned_from; }
  bool is_turned(const std::string& channel) const;
  const MeasurementNoise* noise(const std::string& channel) const;

  /// Whether a test that takes a channel where it was recorded has to take it or be told why not: a
  /// column is called so, whatever is wrong with its unit.
  bool could_be(const std::string& channel, const std::string& unit) const;
  /// The ledgers of its files: what each column was taken for, who uses it, and what is in doubt.
  /// Complete once all who use the measurement were read.
  std::vector<Ledger> ledgers() const;
  /// Somebody uses a channel: "test steady", "experiment side_force". While a study is read.
  void note_use(const std::string& channel, const std::string& by) const;
  /// Somebody could have used a channel and found none; `otherwise`: what it takes instead.
  struct Absent {
    std::string channel, unit, by, otherwise;
  };
  void note_absent(const Absent& absent) const;
  /// Columns that look like a channel of that unit and are taken for none: `Alhpa` for alpha.
  std::vector<std::string> columns_like(const std::string& channel, const std::string& unit) const;
  /// `columns = {alpha = "Alhpa [deg]"}`: the whole table with which a column becomes a channel in
  /// the SI unit `unit`. A unit stands there only if the file states none.
  std::string hint_for(const std::string& channel,
                       const std::string& column,
                       const std::string& unit) const;

 private:
  NamedChannel named(const std::string& channel) const;
  /// Says that a channel has no unit or one of another dimension, and the way out.
  std::string other_dimension(const std::string& found,
                              const std::string& wanted,
                              const std::string& unit) const;

  Told told_;
  std::shared_ptr<std::vector<Absent>> absent_ = std::make_shared<std::vector<Absent>>();
};

/// [measurement.NAME], files beside `folder`. Throws InputError naming file and line.
Measurement read_measurement(const Node& table, const std::filesystem::path& folder);
/// A file about which nothing is said, or only its axes.
Measurement read_measurement(const std::filesystem::path& file,
                             std::optional<AxisConvention> axes = std::nullopt);

/// Any table or recording alone: channels in our names, SI and iso, and the ledger with every
/// doubt. Throws InputError where the file cannot be read; a doubt that is an error is one that a
/// study is refused for.
struct MeasuredFile {
  Channels channels;
  Ledger ledger;
};
MeasuredFile read_measured_file(const std::filesystem::path& file,
                                std::optional<AxisConvention> axes = std::nullopt);

/// Every [measurement.NAME] of a study.
using Laboratory = std::vector<std::shared_ptr<const Measurement>>;
Laboratory read_laboratory(const Node& study, const std::filesystem::path& folder);
/// nullptr where none is called so.
std::shared_ptr<const Measurement> find(const Laboratory& laboratory, const std::string& name);

}  // namespace latsch::correlation
