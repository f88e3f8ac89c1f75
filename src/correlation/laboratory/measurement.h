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
// whatever the file calls them:
//
//   ours           consortium  TYDEX     ours           consortium  TYDEX
//   time           ET          RUNTIME   p              P           INFLPRES
//   Vx             V           LONGVEL   loaded_radius  RL          DSTGRWHC
//   omega          N           WHROTSPD  R_e            RE
//   alpha          SA          SLIPANGL  tread_inner, tread_center, tread_outer   TSTI, TSTC, TSTO
//   gamma          IA          INCLANGL  tread                      TRDTEMP
//   kappa          SR          LONGSLIP  road, ambient  RST, AMBTMP TRCKTEMP, AMBITEMP
//
// Forces and moments are Fx Fy Fz Mx My Mz, of TYDEX with the frame behind it: FyW. Gaps matter
// only in channels that something needs.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
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
    std::map<std::string, std::string> left_out;   // channels that are none, and why
    std::map<std::string, StatedColumn> written;   // how the file has a channel
    std::map<std::string, AxisFrame> turned_from;  // its frame there, where in_frame has turned it
    AxisConvention axes = AxisConvention::iso;
    Channels recorded;            // as read, in our names and axes
    Channels channels;            // what counts
    std::vector<Place> places;    // of its samples
    std::vector<double> numbers;  // of its samples, from 1
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

 private:
  NamedChannel named(const std::string& channel) const;

  Told told_;
};

/// [measurement.NAME], files beside `folder`. Throws InputError naming file and line.
Measurement read_measurement(const Node& table, const std::filesystem::path& folder);
/// A file about which nothing is said.
Measurement read_measurement(const std::filesystem::path& file);

/// Every [measurement.NAME] of a study.
using Laboratory = std::vector<std::shared_ptr<const Measurement>>;
Laboratory read_laboratory(const Node& study, const std::filesystem::path& folder);
/// nullptr where none is called so.
std::shared_ptr<const Measurement> find(const Laboratory& laboratory, const std::string& name);

}  // namespace latsch::correlation
