// SPDX-License-Identifier: Apache-2.0
#include "correlation/comparison/fit_discrepancy.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "correlation/analysis/prediction_bands.h"
#include "correlation/observable/curve.h"
#include "correlation/target/residuals.h"
#include "numerics/dense/cholesky.h"
#include "numerics/signals/sample_count.h"
#include "numerics/signals/welch.h"
#include "optimization/identifiability/robust_rows.h"

namespace latsch::correlation {
namespace {

constexpr double kInverseOfUniform = 12.0;  // inverse variance of a uniform number between 0 and 1

struct ChiSquare {
  double sum = 0.0;
  double count = 0.0;
};

/// The weighted residuals psi (robust_loss.h) of the values that count, with their derivatives,
/// each divided by its standard deviation, and the experiments to which they belong.
struct UsedResiduals {
  Eigen::VectorXd r;
  Eigen::MatrixXd J;
  std::vector<int> experiment;  // -1: a prior
};

UsedResiduals used_residuals(const Study& study, const Identification& identification) {
  const Linearization& at = identification.linearization();
  const auto& used = identification.residuals_used();
  const auto rows = residual_rows(study);
  const ResidualTraits traits = residual_traits(study).of(used);
  const RobustRows limited(at.r, at.J, traits);
  UsedResiduals all{limited.psi(), limited.X(), {}};
  for (std::size_t k = 0; k < used.size(); ++k) {
    const auto row = static_cast<Eigen::Index>(k);
    all.experiment.push_back(rows[static_cast<std::size_t>(used[k])].experiment);
    if (traits.deviations.empty()) continue;
    all.r[row] /= traits.deviations[k];
    all.J.row(row) /= traits.deviations[k];
  }
  return all;
}

/// Returns chi^2 of one experiment whose residuals are predicted from the other experiments.
ChiSquare left_out(const UsedResiduals& all, int experiment, double s) {
  std::vector<Eigen::Index> own, others;
  for (std::size_t k = 0; k < all.experiment.size(); ++k)
    (all.experiment[k] == experiment ? own : others).push_back(static_cast<Eigen::Index>(k));
  const Eigen::MatrixXd J = all.J(others, Eigen::all), J_own = all.J(own, Eigen::all);
  Eigen::MatrixXd M = J.transpose() * J;
  M.diagonal().array() += kInverseOfUniform * s * s;
  const numerics::Cholesky factor(M);
  const Eigen::VectorXd moved = factor.solve(J.transpose() * all.r(others));
  const Eigen::VectorXd e = all.r(own) - J_own * moved;
  // With L^-1 J_g' = W,  (I + W'W)^-1 = I - W' (I + W W')^-1 W.
  const Eigen::MatrixXd W = factor.solve_lower(Eigen::MatrixXd(J_own.transpose()));
  Eigen::MatrixXd inner = W * W.transpose();
  inner.diagonal().array() += 1.0;
  const Eigen::VectorXd We = W * e;
  const double sum = e.squaredNorm() - We.dot(numerics::Cholesky(inner).solve(We));
  return {sum / (s * s), static_cast<double>(own.size())};
}

/// Returns chi^2 of the experiments that are only predicted.
ChiSquare predicted(const Study& study, const Identifiability& what, const Journal& journal) {
  ChiSquare chi;
  const double t = what.identification.confidence().free.t;
  const auto bands = prediction_bands(study, what, journal);
  for (std::size_t i = 0; i < bands.size(); ++i) {
    if (study.experiments[i].fitted || !bands[i].is_known()) continue;
    const auto& measured = study.experiments[i].observable->measured_values();
    for (std::size_t k = 0; k < measured.size(); ++k) {
      const double half = 0.5 * (bands[i].upper[k] - bands[i].lower[k]) / t;
      const double off = measured[k] - bands[i].computed[k];
      const double ratio = off * off / (half * half + bands[i].noise[k] * bands[i].noise[k]);
      if (!std::isfinite(ratio)) continue;
      chi.sum += ratio;
      chi.count += 1.0;
    }
  }
  return chi;
}

/// The simulated and measured signals over time of one experiment.
struct FittedSignal {
  double rate = 0.0;  // Hz
  std::vector<double> measured, simulated;
  // simulated signals with the variables moved along each axis of their uncertainty
  std::vector<std::vector<double>> moved;
  double noise = 0.0;  // mean square noise of a sample
};

bool is_over_time(const StudyExperiment& experiment) {
  const auto* curve = dynamic_cast<const Curve*>(experiment.observable.get());
  if (!curve || !experiment.fitted || !experiment.noise || experiment.objective.weight <= 0.0)
    return false;
  const ComparedCurve what = curve->measured().comparison.what;
  return curve->measured().x_unit == "s" && curve->measured().x_measured.size() > 32 &&
         (what == ComparedCurve::values || what == ComparedCurve::about_mean);
}

std::optional<FittedSignal> signal_of(const Study& study,
                                      const Identification& identification,
                                      const Eigen::MatrixXd& axes,
                                      int experiment) {
  const StudyExperiment& one = study.experiments[static_cast<std::size_t>(experiment)];
  if (!is_over_time(one)) return std::nullopt;
  const Linearization& at = identification.linearization();
  const auto& used = identification.residuals_used();
  const auto rows = residual_rows(study);
  const auto &measured = one.observable->measured_values(), &scales = one.observable->scales();
  const auto& time = dynamic_cast<const Curve&>(*one.observable).measured().x_measured;
  const Eigen::MatrixXd moves = at.J * axes;
  FittedSignal signal;
  signal.rate = static_cast<double>(time.size() - 1) / (time.back() - time.front());
  signal.moved.resize(static_cast<std::size_t>(axes.cols()));
  for (std::size_t k = 0; k < used.size(); ++k) {
    const ResidualRow& row = rows[static_cast<std::size_t>(used[k])];
    if (row.experiment != experiment) continue;
    const std::size_t place = signal.measured.size();
    if (place >= measured.size()) return std::nullopt;
    const double size = row.unit * scales[place];  // size of the difference that is a residual of 1
    const auto index = static_cast<Eigen::Index>(k);
    signal.measured.push_back(measured[place]);
    signal.simulated.push_back(measured[place] - size * at.r[index]);
    for (std::size_t a = 0; a < signal.moved.size(); ++a)
      signal.moved[a].push_back(signal.simulated.back() -
                                size * moves(index, static_cast<Eigen::Index>(a)));
    signal.noise += one.objective.weight * size * size / static_cast<double>(measured.size());
  }
  // if one value is unknown, the whole spectrum is unknown
  if (signal.measured.size() != measured.size()) return std::nullopt;
  return signal;
}

/// Sums over the spectral lines of a third-octave band, for all experiments together.
struct BandSums {
  double squares = 0.0, explained = 0.0, lines = 0.0;
};

/// Returns the number n of the third-octave band around 1 kHz 2^(n/3).
int band_of(double f) { return static_cast<int>(std::lround(3.0 * std::log2(f / 1e3))); }
double center_of(int band) { return 1e3 * std::exp2(band / 3.0); }

void add_lines(const FittedSignal& signal, double segment, std::map<int, BandSums>& bands) {
  constexpr double kAudible = 2.0;  // multiple of the noise density; a weaker line shows only noise
  const auto samples = static_cast<int>(signal.measured.size());
  const auto settings = numerics::welch_settings(
      numerics::Convention::scipy, samples, numerics::sample_count(segment, signal.rate));
  const auto density = [&](const std::vector<double>& x) {
    return numerics::power_density(x, signal.rate, settings);
  };
  const auto measured = density(signal.measured), simulated = density(signal.simulated);
  std::vector<numerics::Density> moved;
  for (const auto& one : signal.moved) moved.push_back(density(one));
  const double N = 2.0 * signal.noise / signal.rate;
  const double K = independent_segments(samples, settings);
  for (std::size_t k = 1; k + 1 < measured.value.size(); ++k) {
    const double S = simulated.value[k], M = S + N;
    if (measured.value[k] < kAudible * N && S < kAudible * N) continue;
    double v = (2.0 * S * N + N * N) / (K * M * M);
    for (const auto& one : moved) v += std::pow(std::log((one.value[k] + N) / M), 2);
    BandSums& band = bands[band_of(measured.frequency[k])];
    band.squares += std::pow(std::log(measured.value[k] / M), 2);
    band.explained += v;
    band.lines += 1.0;
  }
}

}  // namespace

double SpectralDiscrepancy::at(double f) const {
  if (frequency.empty()) return 0.0;
  const auto above = std::lower_bound(frequency.begin(), frequency.end(), f);
  if (above == frequency.begin()) return deviation.front();
  if (above == frequency.end()) return deviation.back();
  const auto i = static_cast<std::size_t>(above - frequency.begin());
  const double share = std::log(f / frequency[i - 1]) / std::log(frequency[i] / frequency[i - 1]);
  return deviation[i - 1] + share * (deviation[i] - deviation[i - 1]);
}

double held_out_error(const Study& study, const Identifiability& what, const Journal& journal) {
  const double s = what.identification.confidence().sigma;
  const UsedResiduals all = used_residuals(study, what.identification);
  std::set<int> experiments(all.experiment.begin(), all.experiment.end());
  experiments.erase(-1);
  ChiSquare chi = predicted(study, what, journal);
  if (experiments.size() > 1) {
    for (const int experiment : experiments) {
      const ChiSquare one = left_out(all, experiment, s);
      chi.sum += one.sum;
      chi.count += one.count;
    }
  }
  if (chi.count == 0.0 || chi.sum / chi.count <= rare_ratio(chi.count)) return 1.0;
  return std::sqrt(chi.sum / chi.count);
}

SpectralDiscrepancy spectral_discrepancy(const Study& study,
                                         const Identifiability& what,
                                         const Eigen::MatrixXd& axes,
                                         double segment) {
  constexpr double kLinesOfAWindow = 1.5;  // a Hann window correlates neighboring lines
  std::map<int, BandSums> bands;
  for (std::size_t e = 0; e < study.experiments.size(); ++e)
    if (const auto signal = signal_of(study, what.identification, axes, static_cast<int>(e)))
      add_lines(*signal, segment, bands);
  SpectralDiscrepancy all;
  for (const auto& [band, sums] : bands) {
    const bool is_chance =
        sums.squares <= rare_ratio(std::max(1.0, sums.lines / kLinesOfAWindow)) * sums.explained;
    all.frequency.push_back(center_of(band));
    all.deviation.push_back(is_chance ? 0.0
                                      : std::sqrt((sums.squares - sums.explained) / sums.lines));
  }
  return all;
}

double independent_segments(int samples, const numerics::WelchSettings& settings) {
  // squared correlation of the spectra of two Hann windows that overlap by half
  constexpr double kShared = 1.0 / 36.0;
  const double count = numerics::segment_count(samples, settings);
  const bool overlaps = 2 * settings.overlap >= settings.segment;
  return overlaps ? count / (1.0 + 2.0 * kShared * (count - 1.0) / count) : count;
}

}  // namespace latsch::correlation
