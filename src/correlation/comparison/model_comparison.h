// SPDX-License-Identifier: Apache-2.0
// Models through the same tests beside a reference, by the spectra of what they record.
//
//   distance   RMS(S - S_ref) / RMS(S_ref) over the lines of a band    [thesis K, 3.3]
//   decibels   sqrt(mean (10 log10 S/S_ref)^2), the log-spectral distance, to which weak lines
//              count like strong ones (measurement/band_level.h)
//
// Bands of a predicted density: numbers a fit leaves unknown are lognormal, independent of each
// other. From slopes: ln S changes by g_i when the number i goes up by its spread, and the band
// is S exp(± z sqrt(Σ g_i^2)), z of the level. From samples: quantiles of S over them, line by
// line. Both hold what the numbers leave open, not what a model lacks: coverage of the reference,
// the share of lines inside, tells how much that is.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "correlation/comparison/model_comparison_file.h"
#include "measurement/channels.h"
#include "numerics/signals/welch.h"

namespace latsch::correlation {

/// One model in one case; spectra by channel.
struct ModelRun {
  std::vector<numerics::Density> densities;
  std::vector<std::vector<double>> distance, decibels;  // by band and channel
  std::vector<std::vector<double>> lower, upper;        // by channel and line; empty: no bands
  std::vector<double> coverage;                         // by channel, of lines in the first band
  std::vector<double> told;                             // means; NaN: it has not that channel
  double cpu = 0.0;                                     // s, of the run itself

  /// Mean over the channels.
  double mean_distance(std::size_t band) const;
  double mean_decibels(std::size_t band) const;
};

struct CaseComparison {
  std::vector<numerics::Density> reference;
  std::vector<ModelRun> models;
};

struct ModelComparison {
  std::vector<CaseComparison> cases;
  std::vector<experiment::Test::Picture> pictures;
};

/// What the reference shows in a case: all it records, with noise.
Channels record_reference(const ModelComparisonFile& file,
                          std::size_t index,
                          const experiment::Language& language);
/// Of that, what is written and compared: time, channels, recorded.
Channels kept_of(const ModelComparisonFile& file, const Channels& all);
/// From its file where there is one, else simulated.
Channels reference_of(const ModelComparisonFile& file,
                      std::size_t index,
                      const experiment::Language& language);

/// With so many threads; what comes out does not depend on their number. Throws InputError where
/// records do not fit each other, std::runtime_error where a model does not come through.
ModelComparison compare_models(const ModelComparisonFile& file,
                               const experiment::Language& language,
                               int threads,
                               const std::function<void(long done, long all)>& tell = {});

/// RMS(a - b) / RMS(b) over the lines of the band.
double psd_distance(const numerics::Density& a, const numerics::Density& b, FrequencyBand band);

}  // namespace latsch::correlation
