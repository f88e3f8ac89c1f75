// SPDX-License-Identifier: Apache-2.0
// From the recordings of a drum rig to passages, averages, spectra and the filter that takes the
// rig away: the steps of thesis K, chapters 2.2 and 3.1, over all runs of a rig file.
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

/// How far it is: `done` of `total` steps, and what is next.
using RigProgress = std::function<void(long done, long total, const std::string& note)>;

struct ChannelAverage {
  std::string name, unit;
  PassageAverage average;
};

/// One run at one speed.
struct ProcessedPlateau {
  Plateau plateau;
  Period period;
  Passages passages;                     // starts counted from plateau.first
  std::vector<ChannelAverage> channels;  // the force first
  Coherence coherence;                   // of the force over the passages
  numerics::Density density;             // of the force's average

  const std::vector<double>& force() const { return channels.front().average.mean; }
};

struct ProcessedRun {
  std::string name;
  DrumRecord record;
  std::vector<ProcessedPlateau> plateaus;  // one for each speed
};

/// Differences between the real rim and something else, about their means, after the delay that
/// makes them least.
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
  RimDifference dummy, filtered;            // against the real rim
  std::vector<double> real, before, after;  // averages without their means, N, aligned to `real`
  numerics::Density real_density, before_density, after_density;
};

/// Deviations over hits drawn again; 0 where none were drawn.
struct ResponseDeviation {
  double gain = 0.0, f = 0.0, zeta = 0.0, c = 0.0;
};

struct HammerResult {
  MeasuredResponse measured;
  FittedResponse fit;
  ResponseDeviation over_hits;
};

struct CompensationResult {
  RigResponse filter_response;        // dummy -> real
  std::optional<FittedResponse> fit;  // where cases were fitted
  ResponseDeviation over_hits;
  numerics::RationalFilter filter;  // at the rate of the runs
  std::vector<CaseRow> cases;
};

struct RigResults {
  std::vector<ProcessedRun> runs;
  std::optional<HammerResult> hammer;
  std::optional<CompensationResult> compensation;
  std::vector<Ledger> ledgers = {};  // of every recording: what each column was taken for
};

/// Throws InputError naming the recording and what to do.
RigResults process(const RigFile& rig, const RigProgress& progress);

/// One recording; its channels may come from anywhere.
ProcessedRun process_run(const RigFile& rig, const std::string& name, DrumRecord record);

/// As long as the rig file's convention wants it, `force` at most.
numerics::Density density_of(const RigFile& rig, const std::vector<double>& force, double rate);

/// The last step: fits the filter and compares the cases.
CompensationResult compensate(const RigFile& rig,
                              const std::vector<ProcessedRun>& runs,
                              const std::optional<HammerResult>& hammer);
HammerResult process_hammer(const RigFile& rig, const DrumRecord& record);

/// A force with the rig's part taken away by a causal filter: its mean stays as it is.
std::vector<double> filtered_force(const numerics::RationalFilter& filter,
                                   std::span<const double> force);

}  // namespace latsch::correlation
