// SPDX-License-Identifier: Apache-2.0
// Several tires through the same drum tests, each beside what was measured.
//
//   time error   RMS(F_sim - F_mea) / RMS(F_mea), both about their means
//   PSD error    RMS(S_sim - S_mea) / RMS(S_mea) over the lines of the band [thesis K, 3.3]
//   level error  L_sim - L_mea in third-octave bands, dB; over tests the root mean square
//
// A tire follows a channel over the longest row of bands whose level error over all tests stays
// within the agreement asked for. Spectra are of the whole record, one Hann window
// (numerics/signals/welch.h, the scipy convention). A band of a test in which the specimen's noise,
// 2 sigma^2/rate, has more than a quarter of the measured power says nothing of a tire and is left
// out; what noise recordings have is not known.
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
  std::vector<bool> heard;    // by band: above the noise; of what was measured
};

struct TireRun {
  std::vector<ComparedRecord> channels;
  std::vector<double> time_error, psd_error;  // by channel, ratios
  double cpu_over_time = 0.0;                 // CPU time over simulated time
};

struct TestComparison {
  std::vector<double> time;  // s
  std::vector<ComparedRecord> measured;
  std::vector<TireRun> tires;
};

/// Of one tire over all tests.
struct TireSummary {
  std::vector<double> time_error, psd_error;     // by channel, means over the tests
  std::vector<std::vector<double>> level_error;  // by channel and band, dB; NaN: never heard
  std::vector<FrequencyBand> follows;            // by channel, Hz; from 0 to 0: no band
  double cpu_over_time = 0.0;                    // mean
};

struct TireComparison {
  std::vector<FrequencyBand> bands;
  std::vector<TestComparison> tests;  // as in the file
  std::vector<TireSummary> tires;
};

/// What the specimen of the file shows in one test: time, speed and the channels with their noise.
Channels measure(const Specimen& specimen, const ComparisonTest& test, std::size_t index);

/// Throws InputError where a measurement does not fit its test, std::runtime_error where a tire
/// does not come through.
TireComparison compare_tires(const ComparisonFile& file,
                             const std::function<void(const std::string&)>& tell = {});

/// One sentence a tire: what it follows up to which frequency, how far off, how fast.
std::vector<std::string> verdicts(const ComparisonFile& file, const TireComparison& comparison);

}  // namespace latsch::correlation
