// SPDX-License-Identifier: Apache-2.0
// Runs models through the same tests and compares them with a reference by the spectra of what they
// record.
//
//   distance   RMS(S - S_ref) / RMS(S_ref) over the lines of a band    [thesis K, 3.3]
//   decibels   sqrt(mean (10 log10 S/S_ref)^2), the log-spectral distance, to which weak lines
//              count like strong ones (measurement/band_level.h)
//
// Bands of a predicted density: a model that comes from fits is evaluated at their best points. The
// uncertainty left by the fits (fit_posterior.h: independent directions of one deviation each,
// correlations included) moves ln S, as do numbers stated by hand, which are lognormal and
// independent. From slopes: ln S changes by g_k along direction k, and the band is S exp(± z b),
//   b^2 = sum g_k^2 + sum delta(f)^2
// with z the quantile of the level and delta the model error that a fit's own spectra show
// (fit_discrepancy.h). From samples: line by line, the quantiles of S over the samples replace the
// slopes.
//
// Coverage is the share of the reference's lines inside the band widened by the reference's noise.
// With N the density of the noise and K independent segments, a measured line of S is distributed
// as
//   (S + N) chi^2_h / h,   h = 2 K (S + N)^2 / (2 S N + N^2)
// [Patnaik, Biometrika 36 (1949) 202: the noncentral chi^2]. Its quantiles (chi_square.h) are added
// to those of the band as roots of sums of squared logarithms.
//
// Coverage treats each line alone. It ignores the uncertainty of numbers that no fit and no table
// names, and model errors that did not show on the fits' rigs.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "correlation/comparison/compared_spectra.h"
#include "correlation/comparison/fit_posterior.h"

namespace latsch::correlation {

/// Result of one model in one case, with its spectra by channel.
struct ModelRun {
  std::vector<double> times;                 // s, of the samples that are compared
  std::vector<std::vector<double>> samples;  // values by channel, SI
  std::vector<numerics::Density> densities;
  std::vector<std::vector<double>> distance, decibels;  // [band][channel]
  std::vector<std::vector<double>> lower, upper;        // [channel][line]; empty: no bands
  std::vector<double> coverage;  // share of lines in the first band; empty: no bands
  std::vector<double> reach;     // mean half width of the band of ln S, each channel
  /// means of the channels in the key `told`; NaN for a channel that the model does not record
  std::vector<double> told;
  /// sentences about limits that the model met, or properties that it or the test lacks
  std::vector<std::string> limits;
  double cpu = 0.0;  // s, CPU time of the model's run alone

  /// Returns the mean distance over the channels in a band.
  double mean_distance(std::size_t band) const;
  double mean_decibels(std::size_t band) const;
};

struct CaseComparison {
  std::vector<std::string> units;            // the units of the compared channels
  std::vector<double> times;                 // s, of the reference's samples
  std::vector<std::vector<double>> samples;  // the reference's values by channel, SI
  std::vector<numerics::Density> reference;
  std::vector<LineNoise> noise;  // noise of the reference, by channel
  std::vector<std::string>
      limits_of_reference;  // limits that the reference met; empty: a recording
  std::vector<ModelRun> models;
};

struct ModelComparison {
  std::vector<FitPosterior> fits;  // in the order of the file
  std::vector<CaseComparison> cases;
  std::vector<experiment::Test::Picture> pictures;
};

/// Returns everything the reference records in a case, noise included. `limits` receives the limits
/// that the reference met, unless it is null.
Channels record_reference(const ModelComparisonFile& file,
                          std::size_t index,
                          const experiment::Language& language,
                          std::vector<std::string>* limits = nullptr);
/// Returns the channels that are written to files and compared: time, the compared channels, and
/// those in the key `recorded`.
Channels kept_of(const ModelComparisonFile& file, const Channels& all);
/// Returns the file of a case's recording, in the folder of the comparison's recordings.
std::filesystem::path recording_file(const ModelComparisonFile& file, std::size_t index);
/// Returns the recipe of a case's recording by the reference: a fingerprint of the reference's
/// numbers, of its test, of the noise and the seed (laboratory/virtual_recording.h).
std::string recipe_of_case(const ModelComparisonFile& file,
                           std::size_t index,
                           const experiment::Language& language);
/// True if the case has a recording of its own and no other case's.
bool is_recorded_here(const ModelComparisonFile& file, std::size_t index);

/// Reads the reference from its file if it has one; otherwise simulates it.
Channels reference_of(const ModelComparisonFile& file,
                      std::size_t index,
                      const experiment::Language& language,
                      std::vector<std::string>* limits = nullptr);

/// Runs the comparison with this many threads; the result does not depend on their number. Throws
/// InputError if records do not fit each other, std::runtime_error if a model fails.
ModelComparison compare_models(const ModelComparisonFile& file,
                               const experiment::Language& language,
                               int threads,
                               const std::function<void(long done, long all)>& tell = {});

/// Returns the limits that the reference and the models have met in their tests, also in runs with
/// moved parameters for the bands, each with the cases in which it was met.
std::vector<std::string> limits_of_models(const ModelComparisonFile& file,
                                          const ModelComparison& comparison);

}  // namespace latsch::correlation
