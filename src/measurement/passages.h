// SPDX-License-Identifier: Apache-2.0
// The passages of a cleat on a plateau: their period, where each begins, their average.
//
//   R(tau) = integral x(t) x(t + tau) dt      its first peak is the period          [thesis K, 2.2]
//
// Each passage is cut a period after the one before, and moved to where its cross-correlation with
// the first passage is greatest; to a fraction of a sample, and read there by band-limited
// interpolation. Whole samples leave a jitter of up to half a sample, which smooths the average
// like a low-pass: 1 - (pi f / rate)^2 / 6 in amplitude.
//
// A passage is as long as the period (whole samples) and has the hit at a set share of it. What a
// drum does between hits is quiet, so a passage's ends join and it can be taken as periodic.
#pragma once

#include <optional>
#include <span>
#include <vector>

namespace latsch {

struct Period {
  double samples = 0.0;
  double strength = 0.0;  // R there, per overlapping sample, over R(0): 1 for a periodic signal
};

/// The period of x between `shortest` and `longest` samples; of several peaks of a comb the first.
/// Nothing where no peak reaches a strength of 0.25: x does not repeat itself.
std::optional<Period> find_period(std::span<const double> x, double shortest, double longest);

struct PassageSettings {
  double hit_at = 0.25;           // of a passage
  double align_below = 250.0;     // Hz, low-pass (no delay) of what is aligned: above the tire's
                                  // answer noise times noise would move the maximum; 0: none
  double most_shift = 0.1;        // of a period, against a period after the one before
  double least_likeness = 0.5;    // normalized cross-correlation; below it a passage is left out
  bool align_to_average = false;  // once more, to the average of the passages aligned to the first
  bool whole_samples = false;     // as the thesis did, for comparison
};

struct Passages {
  double period = 0.0;           // samples
  int length = 0;                // samples of a passage
  std::vector<double> starts;    // samples from the beginning of the signal they were found in
  std::vector<double> likeness;  // to the reference, one each
  int left_out = 0;
};

/// Empty where not even two passages are alike.
Passages find_passages(std::span<const double> x,
                       double rate,
                       double period,
                       const PassageSettings& settings);

/// The samples of one passage of any channel recorded with x.
std::vector<double> passage_values(std::span<const double> x, double start, int length);
/// Passages in rows.
std::vector<std::vector<double>> cut(std::span<const double> x, const Passages& passages);

struct PassageAverage {
  std::vector<double> mean;
  std::vector<double> spread;  // standard deviation over the passages
};

/// The part of the power that every passage repeats,
/// |mean of the spectra|^2 / mean |spectrum|^2 of the passages without their means; 1/passages for
/// noise alone.
struct Coherence {
  std::vector<double> frequency;  // Hz
  std::vector<double> value;
};
Coherence ensemble_coherence(const std::vector<std::vector<double>>& passages, double rate);

PassageAverage average(const std::vector<std::vector<double>>& passages);
/// The mean alone, of the passages chosen (any may come more than once).
std::vector<double> mean_of(const std::vector<std::vector<double>>& passages,
                            const std::vector<int>& chosen);

}  // namespace latsch
