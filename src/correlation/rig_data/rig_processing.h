// SPDX-License-Identifier: Apache-2.0
// Processes the recordings of a drum rig into passages, averages, spectra and the filter that
// removes the rig's response: the steps of thesis K, chapters 2.2 and 3.1, over all runs of a rig
// file.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "correlation/rig_data/rig_file.h"
#include "measurement/drum_record.h"
#include "measurement/ledger.h"
#include "measurement/rig_response_fit.h"

namespace latsch::correlation {

/// Reports progress: `done` of `total` steps, and the next step.
using RigProgress = std::function<void(long done, long total, const std::string& note)>;

struct ChannelAverage {
  std::string name, unit;
  PassageAverage average;
};

/// One run at one speed.
struct ProcessedPlateau {
  Plateau plateau;
  Period period;
  Passages passages;                     // starts are counted from plateau.first
  std::vector<ChannelAverage> channels;  // the force comes first
  Coherence coherence;                   // coherence of the force over the passages
  numerics::Density density;             // spectral density of the force's average

  const std::vector<double>& force() const { return channels.front().average.mean; }
};

struct ProcessedRun {
  std::string name;
  DrumRecord record;
  std::vector<ProcessedPlateau> plateaus;  // one for each speed
};

/// Differences between the signals of the real rim and another one, without their means, after the
/// delay that minimizes them.
struct RimDifference {
  double time = 0.0;   // RMS of the difference, N
  double psd = 0.0;    // RMS over the band's lines of the difference of the densities, N^2/Hz
  double level = 0.0;  // log-spectral distance over the band, dB
};

/// A row of the validation table [thesis K, Table 3-1].
struct CaseRow {
  std::string name;
  bool fitted = false;
  double speed = 0.0;                       // m/s
  RimDifference dummy, filtered;            // differences from the real rim
  std::vector<double> real, before, after;  // averages without their means, N, aligned to `real`
  numerics::Density real_density, before_density, after_density;
};

/// Standard deviations determined by resampling the hits; 0 if there was no resampling.
struct ResponseDeviation {
  double gain = 0.0, f = 0.0, zeta = 0.0, c = 0.0;
};

struct HammerResult {
  MeasuredResponse measured;
  FittedResponse fit;
  ResponseDeviation over_hits;
};

struct CompensationResult {
  RigResponse filter_response;        // response from dummy to real rim
  std::optional<FittedResponse> fit;  // present if cases were fitted
  ResponseDeviation over_hits;
  numerics::RationalFilter filter;  // at the sampling rate of the runs
  std::vector<CaseRow> cases;
};

struct RigResults {
  std::vector<ProcessedRun> runs;
  std::optional<HammerResult> hammer;
  std::optional<CompensationResult> compensation;
  std::vector<Ledger> ledgers = {};  // one for each recording: the meaning of each column
};

/// Throws InputError naming the recording and what to do.
RigResults process(const RigFile& rig, const RigProgress& progress);

/// Processes one recording. The channels need not come from a file.
ProcessedRun process_run(const RigFile& rig, const std::string& name, DrumRecord record);

/// Returns the density with the segment length of the rig file's convention, at most the length of
/// `force`.
numerics::Density density_of(const RigFile& rig, const std::vector<double>& force, double rate);

/// Fits the filter and compares the cases: the last step of the processing (rig_compensation.cpp).
CompensationResult compensate(const RigFile& rig,
                              const std::vector<ProcessedRun>& runs,
                              const std::optional<HammerResult>& hammer);
HammerResult process_hammer(const RigFile& rig, const DrumRecord& record);

/// Returns the force after a causal filter that removes the rig's response. Its mean is unchanged.
std::vector<double> filtered_force(const numerics::RationalFilter& filter,
                                   std::span<const double> force);

}  // namespace latsch::correlation
