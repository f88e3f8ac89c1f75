// SPDX-License-Identifier: Apache-2.0
#include "measurement/rig_response_fit.h"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "numerics/dense/least_squares.h"
#include "numerics/signals/fft.h"
#include "numerics/signals/time_delay.h"

namespace latsch {
namespace {

using Complex = std::complex<double>;
constexpr int kFewestLines = 8;

/// One frequency of the fit: the compared value and its weight.
struct Line {
  double omega;
  Complex H;
  double weight;
};

std::vector<Line> lines_of(const MeasuredResponse& m, FrequencyBand band) {
  constexpr double kNearlyOne = 0.9999;  // the coherence of a single hit is 1 for any noise
  constexpr double kNearlyNone = 0.05;
  std::vector<Line> lines;
  for (std::size_t k = 0; k < m.frequency.size(); ++k) {
    if (m.frequency[k] < band.lower || m.frequency[k] > band.upper) continue;
    const double g2 = std::clamp(m.coherence[k], kNearlyNone, kNearlyOne);
    const double sigma = std::sqrt((1.0 - g2) / (2.0 * m.hits * g2)) * std::abs(m.H[k]);
    if (sigma > 0.0) lines.push_back({kTwoPi * m.frequency[k], m.H[k], 1.0 / sigma});
  }
  if (lines.size() < kFewestLines) {
    throw InputError(
        fmt::format("the band from {:g} to {:g} Hz holds {} frequencies of the "
                    "hammer test, expected {} at least: longer windows or a wider band",
                    band.lower,
                    band.upper,
                    lines.size(),
                    kFewestLines));
  }
  return lines;
}

/// Converts the unknowns of the fit, all of order 1, to a response: log of f over the first guess,
/// zeta, A/f^2, c.
RigResponse response_of(const Eigen::VectorXd& x, double f0) {
  return RigResponse::of(x[2], f0 * std::exp(x[0]), x[1], x[3]);
}

Eigen::VectorXd residuals_of(const std::vector<Line>& lines, const RigResponse& r) {
  Eigen::VectorXd residuals(2 * lines.size());
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const Complex d = lines[i].weight * (r.at(lines[i].omega) - lines[i].H);
    residuals[2 * i] = d.real();
    residuals[2 * i + 1] = d.imag();
  }
  return residuals;
}

/// Returns the response with the least-squares A/f^2 and c for given f and zeta.
RigResponse best_gains(const std::vector<Line>& lines, double f, double zeta) {
  const RigResponse one = RigResponse::of(1.0, f, zeta, 0.0);
  Eigen::MatrixX2d basis(2 * lines.size(), 2);
  Eigen::VectorXd target(2 * lines.size());
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const Complex h = lines[i].weight * one.at(lines[i].omega);
    const Complex H = lines[i].weight * lines[i].H;
    basis.row(2 * i) << h.real(), lines[i].weight;
    basis.row(2 * i + 1) << h.imag(), 0.0;
    target[2 * i] = H.real();
    target[2 * i + 1] = H.imag();
  }
  const Eigen::Vector2d gains = basis.colPivHouseholderQr().solve(target);
  return RigResponse::of(gains[0], f, zeta, gains[1]);
}

/// Returns the best response on a grid of f and zeta over the band.
RigResponse first_guess(const std::vector<Line>& lines) {
  constexpr int kFrequencies = 80;
  RigResponse best;
  double least = -1.0;
  const double lower = lines.front().omega, upper = lines.back().omega;
  for (int i = 0; i < kFrequencies; ++i) {
    const double f = lower * std::pow(upper / lower, (i + 0.5) / kFrequencies);
    for (const double zeta : {0.01, 0.02, 0.05, 0.1, 0.2, 0.5}) {
      const RigResponse r = best_gains(lines, f, zeta);
      const double sum = residuals_of(lines, r).squaredNorm();
      if (least < 0.0 || sum < least) least = sum, best = r;
    }
  }
  return best;
}

FittedResponse result_of(const numerics::LeastSquares& fit, double f0) {
  FittedResponse result;
  result.response = response_of(fit.x, f0);
  const auto sigma = [&](int i) { return std::sqrt(fit.covariance(i, i)); };
  result.sigma_f = sigma(0) * result.response.f;
  result.sigma_zeta = sigma(1);
  result.sigma_gain = sigma(2);
  result.sigma_c = sigma(3);
  result.converged = fit.converged;
  return result;
}

/// The Fourier coefficients of two periodic passages at one frequency.
struct LinePair {
  double omega;
  Complex dummy, real;
};

/// Returns the lines within the band, scaled so that the sum of their squared magnitudes is the
/// mean square of the passage.
std::vector<LinePair> lines_of(const RimPair& pair, double rate, FrequencyBand band) {
  assert(pair.dummy.size() == pair.real.size());
  const int length = static_cast<int>(pair.dummy.size());
  const auto D = numerics::real_fft(pair.dummy, length), R = numerics::real_fft(pair.real, length);
  const double scale = std::numbers::sqrt2 / length;
  std::vector<LinePair> lines;
  for (int k = 1; 2 * k < length; ++k) {
    const double frequency = k * rate / length;
    if (frequency < band.lower || frequency > band.upper) continue;
    lines.push_back({kTwoPi * frequency, scale * D[k], scale * R[k]});
  }
  return lines;
}

/// Returns the delay, s, of the real-rim passage relative to the dummy-rim passage filtered by the
/// start, so that the fit's Newton iteration starts near the solution.
double first_delay(const RimPair& pair, double rate, const RigResponse& start) {
  const int length = static_cast<int>(pair.dummy.size());
  auto D = numerics::real_fft(pair.dummy, length);
  for (int k = 0; k < static_cast<int>(D.size()); ++k) D[k] *= start.at(kTwoPi * k * rate / length);
  D[0] = 0.0;
  auto R = numerics::real_fft(pair.real, length);
  R[0] = 0.0;
  return numerics::delay_between(numerics::inverse_real_fft(D, length),
                                 numerics::inverse_real_fft(R, length),
                                 -length / 4,
                                 length / 4)
             .samples /
         rate;
}

}  // namespace

FittedResponse fit_to_response(const MeasuredResponse& measured,
                               FrequencyBand band,
                               std::optional<RigResponse> start) {
  const std::vector<Line> lines = lines_of(measured, band);
  const RigResponse guess = start ? *start : first_guess(lines);
  const auto fit = numerics::least_squares(
      [&](const Eigen::VectorXd& x) { return residuals_of(lines, response_of(x, guess.f)); },
      Eigen::Vector4d(0.0, guess.zeta, guess.gain(), guess.c));
  FittedResponse result = result_of(fit, guess.f);
  double sum = 0.0;
  for (const Line& line : lines) sum += std::norm(result.response.at(line.omega) - line.H);
  result.residual = std::sqrt(sum / static_cast<double>(lines.size()));
  return result;
}

FittedResponse fit_to_rims(const std::vector<RimPair>& pairs,
                           double rate,
                           FrequencyBand band,
                           const RigResponse& start) {
  assert(!pairs.empty());
  std::vector<std::vector<LinePair>> cases;
  Eigen::VectorXd x(4 + pairs.size());
  x.head<4>() << 0.0, start.zeta, start.gain(), start.c;
  Eigen::Index count = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    cases.push_back(lines_of(pairs[i], rate, band));
    count += 2 * static_cast<Eigen::Index>(cases.back().size());
    x[4 + i] = first_delay(pairs[i], rate, start) * start.f;  // an angle, which is of order 1
  }
  if (count < x.size()) throw InputError("the band of the fit holds too few lines of the passages");
  const auto residuals = [&](const Eigen::VectorXd& x) {
    const RigResponse r = response_of(x, start.f);
    Eigen::VectorXd d(count);
    Eigen::Index row = 0;
    for (std::size_t i = 0; i < cases.size(); ++i) {
      const double delay = x[4 + i] / start.f;
      for (const LinePair& line : cases[i]) {
        const Complex e =
            r.at(line.omega) * line.dummy * std::polar(1.0, -line.omega * delay) - line.real;
        d[row++] = e.real();
        d[row++] = e.imag();
      }
    }
    return d;
  };
  const auto fit = numerics::least_squares(residuals, x);
  FittedResponse result = result_of(fit, start.f);
  result.delay = fit.x[4] / start.f;
  result.residual = std::sqrt(fit.sum / static_cast<double>(pairs.size()));
  return result;
}

}  // namespace latsch
