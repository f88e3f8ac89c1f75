// SPDX-License-Identifier: Apache-2.0
#include "cli/templates/tire_test_record.h"

#include <algorithm>

#include "experiment/rigs/slip/condition_levels.h"

namespace latsch::cli {

double quantile(std::vector<double> values, double share) {
  std::erase_if(values, [](double x) { return !std::isfinite(x); });
  if (values.empty()) return 0.0;
  const auto at = values.begin() + std::lround(share * (std::ssize(values) - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

std::pair<double, double> line_through(const std::vector<double>& x, const std::vector<double>& y) {
  const auto n = static_cast<double>(x.size());
  double mx = 0.0, my = 0.0, xx = 0.0, xy = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    mx += x[i] / n;
    my += y[i] / n;
  }
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += (x[i] - mx) * (x[i] - mx);
    xy += (x[i] - mx) * (y[i] - my);
  }
  const double slope = xx > 0.0 ? xy / xx : 0.0;
  return {slope, my - slope * mx};
}

TireTest::TireTest(const correlation::Measurement& measured) : measured_(measured) {
  cornering = has("Fy") && spread("alpha") > kLeastSweep;
  driving = has("Fx") && spread("kappa") > 2.0 * kFreeRolling;
  combined = cornering && driving && has_combined_slips();
  if (cornering) side_lag = recorded_lag(measured, "Fy", "alpha", kSmallAngle);
  if (driving) drive_lag = recorded_lag(measured, "Fx", "kappa", kSmallSlip);
  lags = (side_lag && side_lag->is_seen()) || (drive_lag && drive_lag->is_seen());
}

bool TireTest::has_combined_slips() const {
  const std::vector<double>&alpha = of("alpha"), &kappa = of("kappa");
  if (alpha.size() != kappa.size()) return false;
  long both = 0;
  for (std::size_t i = 0; i < alpha.size(); ++i)
    both += std::abs(alpha[i]) > kSmallAngle && std::abs(kappa[i]) > kFreeRolling ? 1 : 0;
  return both >= kFewestCombined;
}

magic_formula::ConditionLevels TireTest::levels_of(bool of_driving) const {
  return condition_levels([&](const std::string& channel) {
    std::vector<double> all = of(channel);
    const std::vector<double>& kappa = of("kappa");
    if (!(cornering && driving) || kappa.size() != all.size()) return all;
    std::vector<double> some;
    for (std::size_t i = 0; i < all.size(); ++i)
      if ((std::abs(kappa[i]) > kFreeRolling) == of_driving) some.push_back(all[i]);
    return some;
  });
}

bool TireTest::has(const std::string& channel) const {
  return measured_.has(channel) && quantile(magnitudes(channel), 0.9) > 0.0;
}

const std::vector<double>& TireTest::of(const std::string& channel) const {
  static const std::vector<double> none;
  return measured_.has(channel) ? measured_.values(channel, measured_.unit(channel)) : none;
}

std::vector<double> TireTest::magnitudes(const std::string& channel) const {
  std::vector<double> all = of(channel);
  for (double& one : all) one = std::abs(one);
  return all;
}

double TireTest::steepness(const std::string& force, const std::string& slip, double most) const {
  std::vector<double> x, y;
  const auto &Fz = of("Fz"), &F = of(force), &s = of(slip);
  for (std::size_t i = 0; i < s.size(); ++i) {
    if (std::abs(s[i]) > most || Fz[i] < 0.5 * median("Fz")) continue;
    x.push_back(s[i]);
    y.push_back(F[i] / Fz[i]);
  }
  return x.size() < 3 ? 0.0 : line_through(x, y).first;
}

std::vector<double> TireTest::shares(const std::string& force) const {
  std::vector<double> all = magnitudes(force);
  const double light = 0.2 * median("Fz");
  for (std::size_t i = 0; i < all.size(); ++i)
    all[i] = of("Fz")[i] > light ? all[i] / of("Fz")[i] : 0.0;
  return all;
}

}  // namespace latsch::cli
