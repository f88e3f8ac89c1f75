// SPDX-License-Identifier: Apache-2.0
// Linear bands (prediction_bands.h) beside bands from samples (sampled_bands.h), value by value, in
// the units that people read: for the terminal, the page and STUDY.bands.csv.
//
// The file has one row for each measured value of a fitted experiment:
//
//   experiment,value,unit,measured,computed,linear lower,linear upper,lower,median,upper,density
//   press,10 mm,N,20.4,20.1,19.2,21.0,19.3,20.1,21.2,surrogate
//
// `computed` is the value at the best trial; a band without an end, or that is not known, is nan.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "correlation/analysis/prediction_bands.h"
#include "correlation/posterior/posterior.h"

namespace latsch::correlation {

/// Bands of one experiment; all values in `unit`, one for each row of its observable.
struct ComparedBands {
  int experiment = 0;  // index in the study
  std::string unit = {};
  std::vector<std::string> names = {};   // "10 mm"
  std::string x_name = {}, x_unit = {};  // abscissa of a curve; "value" without one
  std::vector<double> x = {};            // in x_unit; the number of the value without an abscissa
  std::vector<double> measured = {}, computed = {};
  std::vector<double> linear_lower = {}, linear_upper = {};
  std::vector<double> lower = {}, median = {}, upper = {};

  /// Returns the index of the value whose band from samples is widest beside the linear one, or
  /// narrowest if it is narrower by a larger factor; nullopt if no value has both bands.
  std::optional<std::size_t> most_different() const;
};

/// Returns the bands of all fitted experiments that have samples. `linear` has one for each
/// experiment of the study; empty: not known.
std::vector<ComparedBands> compared_bands(const Study& study,
                                          const Posterior& posterior,
                                          const std::vector<ExperimentBand>& linear);

/// Returns the linear bands that the journal determines around the fit; empty if it does not.
std::vector<ExperimentBand> recorded_bands(const Study& study, const Journal& journal);

/// Returns STUDY.bands.csv.
std::filesystem::path bands_file(const Study& study);

/// Writes the file; a crash leaves the old one or the new one. Throws InputError.
void write_bands(const Study& study,
                 const Posterior& posterior,
                 const std::vector<ComparedBands>& bands,
                 const std::filesystem::path& file);

}  // namespace latsch::correlation
