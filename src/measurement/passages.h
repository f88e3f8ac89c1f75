// SPDX-License-Identifier: Apache-2.0
// The passages of a cleat on a plateau: their period, their starts, their average.
//
//   R(tau) = integral x(t) x(t + tau) dt      its first peak is the period          [thesis K, 2.2]
//
// Each passage is cut one period after the one before, moved to the maximum of its
// cross-correlation with the first passage to a fraction of a sample, and evaluated there by
// band-limited interpolation. Whole samples would leave a jitter of up to half a sample, which
// smooths the average like a low-pass: 1 - (pi f / rate)^2 / 6 in amplitude.
//
// A passage is as long as the period (in whole samples) and has the hit at a set share of its
// length. The drum is quiet between hits, so the ends of a passage join and it can be regarded as
// periodic.
#pragma once

#include <optional>
#include <span>
#include <vector>

namespace latsch {

struct Period {
  double samples = 0.0;
  /// R at the period, per overlapping sample, over R(0): 1 for a periodic signal
  double strength = 0.0;
};

/// Returns the period of x between `shortest` and `longest` samples, the first of several peaks of
/// a comb. Returns nothing if no peak reaches a strength of 0.25, because x then does not repeat
/// itself.
std::optional<Period> find_period(std::span<const double> x, double shortest, double longest);

struct PassageSettings {
  double hit_at = 0.25;  // share of a passage
  /// Hz; passages are low-passed (without delay) for the alignment only. Above the tire's own
  /// response, noise correlated with noise would move the maximum. 0: no low-pass
  double align_below = 250.0;
  /// share of a period, relative to one period after the passage before
  double most_shift = 0.1;
  /// least normalized cross-correlation; passages below it are left out
  double least_likeness = 0.5;
  /// true: aligns again, to the average of the passages aligned to the first
  bool align_to_average = false;
  bool whole_samples = false;  // true: aligns to whole samples as the thesis did, for comparison
};

struct Passages {
  double period = 0.0;           // samples
  int length = 0;                // samples of a passage
  std::vector<double> starts;    // samples from the beginning of the signal that was searched
  std::vector<double> likeness;  // likeness of each passage to the reference
  int left_out = 0;
};

/// Returns no passages if not even two are alike.
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

/// Share of the power that every passage repeats, |mean of the spectra|^2 / mean |spectrum|^2 of
/// the passages without their means; 1/passages for noise alone.
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
