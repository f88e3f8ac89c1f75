// SPDX-License-Identifier: Apache-2.0
#include "extrapolated_slope.h"

#include <Eigen/Core>
#include <Eigen/QR>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "numerics/dense/orthogonal_factors.h"

namespace latsch::benchmarks {
namespace {

constexpr std::size_t kFewest = 3;  // steps

/// A central difference.
struct Central {
  double step, value, noise;
};

/// An entry of the table.
struct Difference {
  double value;
  std::vector<double> weights;  // of the plain differences it is made of
};

constexpr double kUnknown = std::numeric_limits<double>::infinity();

/// The best of the table of central differences, each of a step and with the noise in it.
ExtrapolatedSlope extrapolated(const std::vector<Central>& differences) {
  ExtrapolatedSlope found{0.0, kUnknown};
  std::vector<Difference> before;
  for (std::size_t k = 0; k < differences.size(); ++k) {
    Difference plain{differences[k].value, std::vector<double>(differences.size(), 0.0)};
    plain.weights[k] = 1.0;
    std::vector<Difference> row = {std::move(plain)};
    for (std::size_t j = 1; j <= k; ++j) {
      const double ratio = std::pow(differences[k - j].step / differences[k].step, 2);
      const Difference &left = row[j - 1], &above = before[j - 1];
      Difference next{left.value + (left.value - above.value) / (ratio - 1.0), left.weights};
      double squares = 0.0;
      for (std::size_t i = 0; i <= k; ++i) {
        next.weights[i] += (left.weights[i] - above.weights[i]) / (ratio - 1.0);
        squares += std::pow(next.weights[i] * differences[i].noise, 2);
      }
      const double distance =
          std::max(std::abs(next.value - left.value), std::abs(next.value - above.value));
      const double error = std::max(distance, std::sqrt(squares));
      if (error < found.error) {
        found.value = next.value;
        found.error = error;
      }
      row.push_back(std::move(next));
    }
    before = std::move(row);
  }
  return found;
}

/// A value beside the point, less that at it.
struct Place {
  double x, change;
};

/// The slope at zero of the polynomial through places as far as `reach`, and zero, in the sense of
/// least squares; `error` is the noise in it. Nothing where it has less than two places to spare.
std::optional<ExtrapolatedSlope> fitted(const std::vector<Place>& all,
                                        double reach,
                                        int degree,
                                        double noise) {
  std::vector<Place> places;
  for (const Place& place : all) {
    if (std::abs(place.x) <= reach) places.push_back(place);
  }
  const auto count = static_cast<Eigen::Index>(places.size());
  if (count < degree + 2) return std::nullopt;
  Eigen::MatrixXd powers(degree + 1, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    powers(0, i) = 1.0;
    for (int k = 1; k <= degree; ++k) {
      powers(k, i) = powers(k - 1, i) * places[static_cast<std::size_t>(i)].x / reach;
    }
  }
  // The shortest weights that give the slope of every power are those of least squares.
  const Eigen::VectorXd slopes = Eigen::VectorXd::Unit(degree + 1, 1);
  const Eigen::VectorXd weights = numerics::shortest_solution(powers, slopes) / reach;
  ExtrapolatedSlope found{0.0, weights.lpNorm<1>() * noise};
  for (Eigen::Index i = 0; i < count; ++i) {
    found.value += weights[i] * places[static_cast<std::size_t>(i)].change;
  }
  return found;
}

/// The best of polynomials over places to both sides.
ExtrapolatedSlope best_fit(const std::vector<Place>& places,
                           const std::vector<double>& reaches,
                           double noise) {
  constexpr int kHighest = 5;
  ExtrapolatedSlope found{0.0, kUnknown};
  for (std::size_t r = 0; r + 1 < reaches.size(); ++r) {
    for (int degree = 1; degree < kHighest; ++degree) {
      const auto fit = fitted(places, reaches[r], degree, noise);
      const auto higher = fitted(places, reaches[r], degree + 1, noise);
      const auto nearer = fitted(places, reaches[r + 1], degree, noise);
      if (!fit || !higher || !nearer) continue;
      const double error = std::max(
          {fit->error, std::abs(fit->value - higher->value), std::abs(fit->value - nearer->value)});
      if (error < found.error) found = {fit->value, error};
    }
  }
  return found;
}

}  // namespace

std::optional<ExtrapolatedSlope> extrapolated_slope(const std::vector<StepValues>& steps,
                                                    double at,
                                                    double noise) {
  std::vector<Central> central;
  std::vector<Place> places = {{0.0, 0.0}};
  std::vector<double> reaches;
  std::size_t below_known = 0, above_known = 0;
  for (const auto& [h, below, above] : steps) {
    if (below && above)
      central.push_back({h, (*above - *below) / (2.0 * h), noise / (std::sqrt(2.0) * h)});
    if (below) places.push_back({-h, *below - at});
    if (above) places.push_back({h, *above - at});
    if (below || above) reaches.push_back(h);
    below_known += below.has_value();
    above_known += above.has_value();
  }
  if (std::max(below_known, above_known) < kFewest) return std::nullopt;
  ExtrapolatedSlope found = best_fit(places, reaches, noise);
  if (central.size() >= kFewest) {
    const ExtrapolatedSlope other = extrapolated(central);
    if (other.error < found.error) found = other;
  } else {
    found.one_sided = true;
  }
  if (found.error == kUnknown) return std::nullopt;
  return found;
}

ExtrapolatedSlope fitted_slope(const std::vector<PlacedValue>& values) {
  constexpr int kLowest = 3, kHighest = 7, kMore = 2;
  constexpr double kDeviations = 3.0;
  const auto count = static_cast<Eigen::Index>(values.size());
  assert(count >= 16);
  double reach = 0.0;
  for (const auto& [x, value] : values) reach = std::max(reach, std::abs(x));
  Eigen::MatrixXd powers(count, kHighest + kMore + 1);
  Eigen::VectorXd of(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto& [x, value] = values[static_cast<std::size_t>(i)];
    of[i] = value - values.front().value;
    powers(i, 0) = 1.0;
    for (Eigen::Index k = 1; k < powers.cols(); ++k) powers(i, k) = powers(i, k - 1) * x / reach;
  }
  // (slope, its standard deviation), without reach
  const auto fit = [&](int degree) {
    const Eigen::MatrixXd some = powers.leftCols(degree + 1);
    const Eigen::HouseholderQR<Eigen::MatrixXd> qr(some);
    const Eigen::VectorXd coefficients = qr.solve(of);
    const double left =
        (of - some * coefficients).squaredNorm() / static_cast<double>(count - degree - 1);
    const Eigen::VectorXd slope = Eigen::VectorXd::Unit(degree + 1, 1);
    const Eigen::VectorXd weights =
        qr.matrixQR().topRows(degree + 1).triangularView<Eigen::Upper>().transpose().solve(slope);
    return std::pair(coefficients[1], std::sqrt(left) * weights.norm());
  };
  ExtrapolatedSlope found{0.0, kUnknown};
  for (int degree = kLowest; degree <= kHighest; degree += kMore) {
    const auto [slope, deviation] = fit(degree);
    const double error =
        std::max(kDeviations * deviation, 2.0 * std::abs(slope - fit(degree + kMore).first));
    if (error < found.error * reach) found = {slope / reach, error / reach};
  }
  return found;
}

}  // namespace latsch::benchmarks
