// SPDX-License-Identifier: Apache-2.0
// Reads recordings of a laboratory, and selects and processes their samples. An experiment names a
// recording as its measurement; a test takes its conditions from it. Only the stated processing
// steps are done, in the order of their keys in correlation/laboratory/measurement_keys.cpp.
//
// Channels have Latsch's names and SI units, in iso axes, whatever the names in the file: the
// vocabulary knows SA, SLIPANGL, slip angle and others as alpha
// (measurement/meaning/channel_words.h). Signs and ranges of the selected samples are checked.
// Every file has a ledger of the meaning of its columns (measurement/ledger.h). Forces and moments
// are Fx Fy Fz Mx My Mz; with TYDEX the frame is appended: FyW. Gaps matter only in channels that a
// test or an experiment needs.
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
#include "measurement/meaning/absent_channel.h"

namespace latsch::correlation {

class Measurement {
 public:
  struct Told {
    std::string name;       // for example "cornering"; the file's own name if there is no table
    Place place;            // place of its table, or the header of the file
    bool is_stated = true;  // true if a [measurement.NAME] states it
    std::vector<std::filesystem::path> files;
    std::string frame;
    std::vector<std::string> words;  // samples read and result of each step, a line each
    // processing steps that lose information, such as "low_pass", and that a twin therefore cannot
    // undo
    std::vector<std::string> one_way;
    std::map<std::string, MeasurementNoise> noise;
    std::map<std::string, std::string> left_out;          // columns that are no channels, and why
    std::map<std::string, StatedColumn> written;          // a channel as named in the file
    std::map<std::string, StatedColumn> stated;           // the table `columns`
    std::map<std::string, formats::TableColumn> sources;  // a channel as its file states it
    // The original frame of each channel that in_frame has converted.
    std::map<std::string, AxisFrame> turned_from;
    AxisConvention axes = AxisConvention::iso;
    std::shared_ptr<std::vector<Ledger>> ledgers;  // one for each file
    std::map<std::string, std::string> ambiguous;  // channels that two columns claim, in words
    // Doubts about numbers that are probably not measured values; such an error counts only if
    // something uses the channel.
    std::vector<LedgerDoubt> suspects;
    // structs of the MAT file, if none of them was chosen
    std::vector<std::string> structs;
    std::string part_word = "struct";  // "group" if those are groups of different rates
    // all samples as read, in Latsch's names and axes
    Channels recorded;
    Channels channels;            // processed and selected samples
    std::vector<Place> places;    // index in the file of each selected sample
    std::vector<double> numbers;  // number of each selected sample, from 1
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
  /// Returns a channel in the SI unit `unit`. Throws InputError if there is none (the message lists
  /// similar names), if it has another dimension, or if it has gaps (the message says how many and
  /// where).
  const std::vector<double>& values(const std::string& channel, const std::string& unit) const;
  /// Returns the SI unit of an existing channel.
  const std::string& unit(const std::string& channel) const;
  /// Returns the frame "W", "H" or "C" of a force or moment if its name or the table states it;
  /// otherwise "".
  std::string frame(const std::string& channel) const;
  /// Returns the channel's name in its file.
  std::string name_of(const std::string& channel) const;
  /// Returns the channel's column and unit in the file.
  const StatedColumn& written(const std::string& channel) const;
  /// Returns the table `columns` of the study.
  const std::map<std::string, StatedColumn>& stated_columns() const { return told_.stated; }
  /// Returns the forces and moments that in_frame has converted, with their frame in the file.
  const std::map<std::string, AxisFrame>& turned_from() const { return told_.turned_from; }
  bool is_turned(const std::string& channel) const;
  const MeasurementNoise* noise(const std::string& channel) const;

  /// True if a column has this name, whatever its unit. A test that takes a channel as recorded
  /// then has to use it, or report why it cannot.
  bool could_be(const std::string& channel, const std::string& unit) const;
  /// Returns the ledgers of the files: the meaning of each column, its users, and doubts. They are
  /// complete after all users of the measurement were read.
  std::vector<Ledger> ledgers() const;
  /// Notes, while a study is read, that a channel is used by "test steady" or "experiment
  /// side_force".
  void note_use(const std::string& channel, const std::string& by) const;
  /// Notes that `by` reads a channel but does not use it in its computation, and why.
  void note_ignored(const std::string& channel,
                    const std::string& by,
                    const std::string& why) const;
  /// A channel that the recording lacks although a user could have used it; `otherwise` is what is
  /// used instead.
  struct Absent {
    std::string channel, unit, by, otherwise;
  };
  void note_absent(const Absent& absent) const;
  /// Returns an error for every key of `columns` that is no known channel and that nothing uses,
  /// for example "alpa" for alpha. It is complete only after all users of the measurement have been
  /// read.
  std::vector<LedgerDoubt> unknown_keys() const;
  /// Returns columns that look like a channel of that unit but were not recognized: `Alhpa` for
  /// alpha.
  std::vector<std::string> columns_like(const std::string& channel, const std::string& unit) const;
  /// Returns the table that makes a column a channel with the SI unit `unit`: `columns = {alpha =
  /// "Alhpa [deg]"}`. It contains the unit only if the file states none.
  std::string hint_for(const std::string& channel,
                       const std::string& column,
                       const std::string& unit) const;

 private:
  NamedChannel named(const std::string& channel) const;
  /// Returns a clause that says what to state in the study if a channel is missing: the columns
  /// that may be this channel, or the structs of the file.
  std::string way_out_of_missing(const std::string& channel, const std::string& unit) const;
  /// Returns advice on what to state if a column is the missing channel: `say columns = {toe =
  /// "toe_left"}`.
  std::string advice_for(const std::string& channel,
                         const std::string& unit,
                         const MayBe& column) const;
  /// Returns a message that a channel has no unit, or a unit of another dimension than the wanted
  /// one, and the remedy.
  std::string other_dimension(const std::string& found,
                              const std::string& wanted,
                              const std::string& unit) const;

  Told told_;
  std::shared_ptr<std::vector<Absent>> absent_ = std::make_shared<std::vector<Absent>>();
};

/// Reads [measurement.NAME]; file names are relative to `folder`. Throws InputError naming file and
/// line.
Measurement read_measurement(const Node& table, const std::filesystem::path& folder);
/// Reads a single file outside of a study; only its axes can be stated.
Measurement read_measurement(const std::filesystem::path& file,
                             std::optional<AxisConvention> axes = std::nullopt);

/// A table or recording that is read outside of a study: channels in Latsch's names, SI and iso,
/// and the ledger with every doubt. Reading throws InputError if the file cannot be read. A doubt
/// that is an error would make a study refuse the file.
struct MeasuredFile {
  Channels channels;
  Ledger ledger;
};
MeasuredFile read_measured_file(const std::filesystem::path& file,
                                std::optional<AxisConvention> axes = std::nullopt);

/// Every [measurement.NAME] of a study.
using Laboratory = std::vector<std::shared_ptr<const Measurement>>;
Laboratory read_laboratory(const Node& study, const std::filesystem::path& folder);
/// Returns nullptr if none has the given name.
std::shared_ptr<const Measurement> find(const Laboratory& laboratory, const std::string& name);

}  // namespace latsch::correlation
