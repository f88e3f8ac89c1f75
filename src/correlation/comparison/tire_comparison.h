// SPDX-License-Identifier: Apache-2.0
// Runs several tires through the same drum tests and compares each with the measurement.
//
//   time error   RMS(F_sim - F_mea) / RMS(F_mea), both about their means
//   PSD error    RMS(S_sim - S_mea) / RMS(S_mea) over the lines of the band [thesis K, 3.3]
//   level error  L_sim - L_mea in third-octave bands, dB; root mean square over the tests
//
// A tire reproduces a channel over the longest sequence of adjacent bands whose level error over
// all tests is within the stated agreement. Spectra use the whole record with one Hann window
// (numerics/signals/welch.h, the scipy convention). If the specimen's noise, 2 sigma^2/rate, has
// more than a quarter of the measured power in a band of a test, the band is left out, because it
// does not show the tire. The noise of recordings is not known. Bands above half the rate of a
// recording are left out, too.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "correlation/comparison/comparison_file.h"
#include "measurement/channels.h"
#include "numerics/signals/welch.h"

namespace latsch::correlation {

/// One channel of one run.
struct ComparedRecord {
  std::vector<double> force;  // N or N m
  numerics::Density density;
  std::vector<double> level;  // dB, by band
  std::vector<bool> heard;    // [band], for measured records: the power exceeds the noise
};

struct TireRun {
  std::vector<ComparedRecord> channels;
  std::vector<double> time_error, psd_error;  // ratios, one for each channel
  /// CPU time over simulated time, which includes the run-in and all passages, if the tire has them
  double cpu_over_time = 0.0;
  /// Sentences on limits that the tire met: validity ranges of its file that it left, a lost
  /// contact, effects that its model lacks.
  std::vector<std::string> limits;
};

struct TestComparison {
  std::vector<double> time;  // s
  double highest = 0.0;      // Hz; the records contain nothing above it
  std::vector<ComparedRecord> measured;
  std::vector<TireRun> tires;
  double specimen_cpu_over_time = 0.0;  // CPU time over simulated time; 0: recorded
};

/// Errors of one tire over all tests.
struct TireSummary {
  std::vector<double> time_error, psd_error;  // means over the tests, one for each channel
  /// Means over the tests to which no tire was fitted, one for each channel; empty if the file
  /// calls no test or every test fitted.
  std::vector<double> held_out_time_error, held_out_psd_error;
  /// errors of the levels, dB, [channel][band]; NaN if noise hides the tire in all tests
  std::vector<std::vector<double>> level_error;
  /// for each channel the frequency range, Hz, that the tire reproduces; from 0 to 0: none
  std::vector<FrequencyBand> follows;
  double cpu_over_time = 0.0;  // mean
};

struct TireComparison {
  std::vector<FrequencyBand> bands;
  std::vector<TestComparison> tests;  // in the order of the file
  std::vector<TireSummary> tires;
  std::vector<std::string> remarks;  // parts of the band that a record does not contain
  /// Sentences on limits that the specimen met, each with its tests; empty if the specimen was
  /// recorded.
  std::vector<std::string> limits_of_specimen;
  /// Mean CPU time of the specimen over simulated time; 0 if the specimen was recorded.
  double specimen_cpu_over_time = 0.0;
};

/// Returns what the specimen of the file records in one test: time, speed and the channels with
/// their noise. `limits` receives the limits that the specimen met, unless it is null.
Channels measure(const ComparedSpecimen& specimen,
                 const ComparisonTest& test,
                 std::size_t index,
                 std::vector<std::string>* limits = nullptr);

/// Returns the limits that a tire of the file met, each with the names of the tests.
std::vector<std::string> limits_of_tire(const ComparisonFile& file,
                                        const TireComparison& comparison,
                                        std::size_t tire);

/// Throws InputError if a measurement does not fit its test, std::runtime_error if a tire fails.
TireComparison compare_tires(const ComparisonFile& file,
                             const std::function<void(const std::string&)>& tell = {});

/// Returns the number of tests to which the tires were not fitted, or 0 if the file calls no test
/// or every test fitted.
std::size_t held_out_tests(const ComparisonFile& file);

/// Returns one sentence for each tire: the channels it reproduces and up to which frequency, its
/// error, its speed, and its error in the tests that were held out, if some were.
std::vector<std::string> verdicts(const ComparisonFile& file, const TireComparison& comparison);

}  // namespace latsch::correlation
