// SPDX-License-Identifier: Apache-2.0
#include "correlation/observable/close_modes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace latsch::correlation {
namespace {

using experiment::ModeRecord;

// relative distance of frequencies within which the shapes of two modes may mix
constexpr double kMixing = 0.05;
constexpr double kDouble = 1e-5;  // modes nearer than this may be one double mode
// largest distance from the measured frequency for a member of a double mode
constexpr double kAsGood = 0.01;

struct Share {
  double value, slope;  // s, ds/dg
};

Share share_of(double g, const CloseModes& close) {
  const double width = close.apart - close.alike;
  if (g <= close.alike) return {1.0, 0.0};
  if (g >= close.apart) return {0.0, 0.0};
  const double t = (close.apart - g) / width;
  return {t * t * (3.0 - 2.0 * t), -6.0 * t * (1.0 - t) / width};
}

/// Puts a and b in order if their frequencies are close, where a is compared with the lower
/// measured mode. Does nothing if the order already agrees or if the modes are far enough apart
/// that their names are reliable.
void exchange(ComparedFrequency& a, ComparedFrequency& b, const CloseModes& close) {
  const double d = a.frequency - b.frequency, sum = a.frequency + b.frequency;
  if (!(d > 0.0)) return;
  const auto [s, ds] = share_of(2.0 * d / sum, close);
  if (s == 0.0) return;
  for (std::size_t i = 0; i < a.slopes.size(); ++i) {
    const double da = a.slopes[i], db = b.slopes[i];
    const double dg = 2.0 * ((da - db) / sum - d * (da + db) / (sum * sum));
    const double change = s * (da - db) + ds * dg * d;
    a.slopes[i] = da - change;
    b.slopes[i] = db + change;
  }
  a.frequency -= s * d;
  b.frequency += s * d;
  a.beside = b.measured;
  b.beside = a.measured;
}

double distance(double a, double b) { return std::abs(a - b) / std::max(a, b); }

}  // namespace

bool same_waves(const ModeRecord& a, const ModeRecord& b) {
  const bool same_phase = a.phase == ' ' || b.phase == ' ' || a.phase == b.phase;
  return a.n && b.n && *a.n == *b.n && same_phase;
}

void take_mixed(const std::vector<ModeRecord>& measured,
                const std::vector<ModeRecord>& simulated,
                std::vector<int>& partner) {
  std::vector<bool> used(simulated.size(), false);
  for (const int j : partner)
    if (j >= 0) used[static_cast<std::size_t>(j)] = true;
  for (std::size_t i = 0; i < measured.size(); ++i) {
    if (partner[i] >= 0) continue;
    const auto mixes = [&](const ModeRecord& mode) {
      return std::any_of(simulated.begin(), simulated.end(), [&](const ModeRecord& other) {
        const double apart = distance(mode.frequency, other.frequency);
        const bool is_double =
            apart < kDouble && distance(mode.frequency, measured[i].frequency) > kAsGood;
        return &other != &mode && same_waves(mode, other) && !is_double && apart < kMixing;
      });
    };
    int nearest = -1;
    double least = kMixing;
    for (std::size_t j = 0; j < simulated.size(); ++j) {
      const double apart = distance(measured[i].frequency, simulated[j].frequency);
      if (used[j] || apart >= least || !same_waves(measured[i], simulated[j])) continue;
      if (!mixes(simulated[j])) continue;
      nearest = static_cast<int>(j);
      least = apart;
    }
    if (nearest < 0) continue;
    partner[i] = nearest;
    used[static_cast<std::size_t>(nearest)] = true;
  }
}

void order_close(const std::vector<ModeRecord>& measured,
                 const CloseModes& close,
                 bool needs_waves,
                 std::vector<ComparedFrequency>& compared) {
  std::vector<ComparedFrequency*> order;
  for (ComparedFrequency& one : compared) order.push_back(&one);
  const auto mode = [&](const ComparedFrequency* one) -> const ModeRecord& {
    return measured[static_cast<std::size_t>(one->measured)];
  };
  std::stable_sort(order.begin(), order.end(), [&](const auto* a, const auto* b) {
    return mode(a).frequency < mode(b).frequency;
  });
  for (std::size_t a = 0; a < order.size(); ++a) {
    for (std::size_t b = a + 1; b < order.size(); ++b) {
      if (needs_waves && !same_waves(mode(order[a]), mode(order[b]))) continue;
      if (mode(order[a]).frequency == mode(order[b]).frequency) continue;
      exchange(*order[a], *order[b], close);
    }
  }
}

std::vector<std::string> remarks_on_close(const std::vector<ModeRecord>& measured,
                                          const CloseModes& close,
                                          const std::vector<ComparedFrequency>& compared) {
  std::vector<std::string> all;
  for (const ComparedFrequency& one : compared) {
    if (one.beside < one.measured) continue;  // no exchange, or it is reported with the other mode
    all.push_back(fmt::format(
        "{} and {} are simulated within {:g} % of one another, in the other order than measured: "
        "that is too close to tell them apart, so their frequencies are compared in their order.",
        measured[static_cast<std::size_t>(one.measured)].label(),
        measured[static_cast<std::size_t>(one.beside)].label(),
        100.0 * close.apart));
  }
  return all;
}

std::string remark_on_mixed(const ModeRecord& measured) {
  return fmt::format(
      "No simulated mode is called {}: one of its n that lies close to another is compared with "
      "it, "
      "because a mixture of two is named after the larger part of its energy.",
      measured.label());
}

}  // namespace latsch::correlation
