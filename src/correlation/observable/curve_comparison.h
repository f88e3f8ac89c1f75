// SPDX-License-Identifier: Apache-2.0
// Quantities by which two curves y(x) can be compared. Each value is a separate residual:
//
//   values       y at every measured x: the time series, or force over slip
//   about_mean   y minus its mean: a constant offset does not matter
//   psd          power spectral density of y over time: neither an offset nor a phase matters
//                [thesis K, 3.3: the cost is the RMS between the densities, exponent = 2]
//   band_levels  level of y in third-octave bands in dB: weak bands count as much as strong ones
//   path         distance of every measured point (x, y) from the simulated line in the plane of
//                x / x_scale and y / scale: on a steep curve a small shift of x is a small error,
//                and the curve may turn back (up and down a slip sweep)
//
// The keys are in correlation/observable/keys/curve_comparison_keys.cpp.
#pragma once

#include <string>
#include <vector>

#include "base/document.h"
#include "measurement/rig_response_fit.h"
#include "numerics/signals/welch.h"

namespace latsch::correlation {

enum class ComparedCurve { values, about_mean, psd, band_levels, path };

struct CurveComparison {
  ComparedCurve what = ComparedCurve::values;
  double rate = 0.0;              // Hz; psd and band_levels
  FrequencyBand band;             // Hz
  numerics::WelchSettings welch;  // for the number of measured samples
  double x_scale = 1.0;           // used by path

  bool of_spectrum() const {
    return what == ComparedCurve::psd || what == ComparedCurve::band_levels;
  }
};

/// Reads compare, band, convention, segment, rate and x_scale for a measured curve (SI). Throws
/// InputError if times are not uniform or the band holds no line.
CurveComparison read_comparison(const Node& table,
                                const std::vector<double>& x,
                                const std::vector<double>& y,
                                const std::string& x_unit);

/// Returns the compared values of a curve given at the measured abscissas (not for path).
std::vector<double> compared_values(const CurveComparison& comparison,
                                    const std::vector<double>& y);
/// Returns the frequencies of the compared values, Hz (psd, band_levels).
std::vector<double> compared_frequencies(const CurveComparison& comparison);

/// Returns the signed distance of the point (x, y) from the line through (xs, ys), all already
/// scaled. It is positive on the line's left.
double path_distance(double x,
                     double y,
                     const std::vector<double>& xs,
                     const std::vector<double>& ys);

}  // namespace latsch::correlation
