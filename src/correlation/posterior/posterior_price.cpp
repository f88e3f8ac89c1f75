// SPDX-License-Identifier: Apache-2.0
#include "correlation/posterior/posterior_price.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/text.h"
#include "optimization/posterior/chain_diagnostics.h"

namespace latsch::correlation {
namespace {

/// Time to send a trial to a worker and to store it in the journal, s, about as measured on a disk
/// that is busy. Larger: the price of short trials is overstated.
constexpr double kStoring = 3e-3;

/// Returns "4 ms", "16 s", "12 min", "3.1 h".
std::string duration_text(double seconds) {
  if (seconds < 1.0) return fmt::format("{:.2g} ms", 1e3 * seconds);
  if (seconds < 100.0) return fmt::format("{:.2g} s", seconds);
  if (seconds < 6000.0) return fmt::format("{:.0f} min", seconds / 60.0);
  return fmt::format("{:.1f} h", seconds / 3600.0);
}

}  // namespace

double median_trial_time(const Journal& journal) {
  std::vector<double> times;
  journal.for_each([&](const Trial& trial) {
    if (trial.outcome.result) times.push_back(trial.outcome.wall_time);
  });
  if (times.empty()) return NAN;
  return quantile_of(Eigen::Map<const Eigen::VectorXd>(times.data(), std::ssize(times)), 0.5);
}

std::string price_text(const Study& study, double seconds) {
  const PosteriorSettings& settings = study.posterior;
  if (settings.method == PosteriorMethod::surrogate) return "";
  const bool is_delayed = settings.method == PosteriorMethod::delayed;
  std::string text = fmt::format("{} {} at most {} trials of the model",
                                 is_delayed ? "Delayed acceptance" : "Chains on the model alone",
                                 is_delayed ? "takes" : "take",
                                 settings.chain_runs);
  if (!std::isfinite(seconds)) return text + ".";
  const int workers = std::max(1, study.run.workers);
  const double whole = static_cast<double>(settings.chain_runs) * (seconds / workers + kStoring);
  text += fmt::format(
      "; at {} a trial, the median so far, and {} to store it, about {} on {} worker{}.",
      duration_text(seconds),
      duration_text(kStoring),
      duration_text(whole),
      workers,
      workers == 1 ? "" : "s");
  if (!is_delayed && seconds > kShortTrial)
    text += fmt::format(
        " A trial takes longer than {}: method = \"delayed\" needs a tenth of the trials.",
        duration_text(kShortTrial));
  return text;
}

}  // namespace latsch::correlation
