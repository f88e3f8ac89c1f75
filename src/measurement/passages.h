// SPDX-License-Identifier: Apache-2.0
// The passages of a cleat while the drum runs at constant speed: their period, their starts, their
// average.
//
//   R(tau) = integral x(t) x(t + tau) dt      its first peak is the period          [thesis K, 2.2]
//
// Each passage is cut one period after the one before, shifted by a fraction of a sample to the
// maximum of its cross-correlation with the first passage, and evaluated there by band-limited
// interpolation. Shifts by whole samples would leave a jitter of up to half a sample, which smooths
// the average like a low-pass filter: 1 - (pi f / rate)^2 / 6 in amplitude.
//
// A passage is as long as the period (in whole samples) and has the hit at a given share of its
// length. Between hits the force is nearly constant, so the ends of a passage join and it can be
// regarded as periodic.
#pragma once

#include <optional>
#include <span>
#include <vector>

namespace latsch {

struct Period {
  double samples = 0.0;
  /// R at the period, divided by the number of overlapping samples and by R(0): 1 for a periodic
  /// signal.
  double strength = 0.0;
};

/// Returns the period of x between `shortest` and `longest` samples, the first of several peaks of
/// a comb. Returns nothing if no peak reaches a strength of 0.25, because x then does not repeat
/// itself.
std::optional<Period> find_period(std::span<const double> x, double shortest, double longest);

struct PassageSettings {
  double hit_at = 0.25;  // share of a passage
  /// Frequency, Hz: passages are low-pass filtered (without delay) for the alignment only. Above
  /// the frequencies of the tire's response, correlated noise would shift the maximum. 0: no
  /// filter.
  double align_below = 250.0;
  /// largest shift of a passage from the position one period after the previous passage, as a share
  /// of the period
  double most_shift = 0.1;
  /// Least normalized cross-correlation with the reference; passages below it are left out.
  double least_likeness = 0.5;
  /// True: aligns again, with the average of the passages that were aligned with the first one.
  bool align_to_average = false;
  bool whole_samples = false;  // true: shifts by whole samples as in the thesis, for comparison
};

struct Passages {
  double period = 0.0;           // samples
  int length = 0;                // samples of a passage
  std::vector<double> starts;    // samples from the beginning of the signal that was searched
  std::vector<double> likeness;  // normalized cross-correlation of each passage with the reference
  int left_out = 0;
};

/// Returns no passages if fewer than two are similar.
Passages find_passages(std::span<const double> x,
                       double rate,
                       double period,
                       const PassageSettings& settings);

/// Returns the samples of one passage in any channel recorded with x.
std::vector<double> passage_values(std::span<const double> x, double start, int length);
/// Returns one passage in each row.
std::vector<std::vector<double>> cut(std::span<const double> x, const Passages& passages);

struct PassageAverage {
  std::vector<double> mean;
  std::vector<double> spread;  // standard deviation over the passages
};

/// Share of the power that repeats in every passage, |mean of the spectra|^2 / mean |spectrum|^2,
/// for passages without their means; 1/(number of passages) for noise alone.
struct Coherence {
  std::vector<double> frequency;  // Hz
  std::vector<double> value;
};
Coherence ensemble_coherence(const std::vector<std::vector<double>>& passages, double rate);

PassageAverage average(const std::vector<std::vector<double>>& passages);
/// Returns only the mean of the chosen passages, which may be repeated.
std::vector<double> mean_of(const std::vector<std::vector<double>>& passages,
                            const std::vector<int>& chosen);

}  // namespace latsch
