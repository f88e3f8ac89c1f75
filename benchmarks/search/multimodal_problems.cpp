// SPDX-License-Identifier: Apache-2.0
#include "multimodal_problems.h"

#include <cmath>
#include <utility>

#include "base/random.h"

namespace latsch::benchmarks {
namespace {

using Values = std::vector<double>;
using Curve = std::function<Values(const Values&)>;

constexpr double kTurn = 6.283185307179586;

struct Range {
  std::string name;
  double lower, upper;
};

/// Draws true values inside the middle 80 % of the ranges, and a start anywhere in them.
MultimodalProblem fitted(std::string name,
                         const std::vector<Range>& ranges,
                         const Curve& curve,
                         std::uint64_t seed) {
  RandomStream random(77, seed);
  Values truth;
  std::vector<DesignVariable> variables;
  for (const Range& range : ranges) {
    const double width = range.upper - range.lower;
    truth.push_back(range.lower + width * (0.1 + 0.8 * random.uniform()));
    variables.push_back({.name = range.name,
                         .lower = range.lower,
                         .upper = range.upper,
                         .initial = range.lower + width * random.uniform()});
  }
  const Values data = curve(truth);
  auto residuals = [curve, data](const Values& x) {
    Values r = curve(x);
    for (std::size_t k = 0; k < r.size(); ++k) r[k] -= data[k];
    return r;
  };
  return {std::move(name), DesignSpace(variables), residuals, truth};
}

Values sampled(int count, const std::function<double(double)>& f) {
  Values y;
  for (int k = 0; k < count; ++k) y.push_back(f(k / (count - 1.0)));
  return y;
}

/// A decaying oscillation over a second, many cycles.
Values oscillation(const Values& x) {
  return sampled(80,
                 [&](double t) { return x[0] * std::exp(-x[1] * t) * std::sin(kTurn * x[2] * t); });
}
/// A decaying oscillation with a phase and an offset.
Values oscillation_with_phase(const Values& x) {
  return sampled(80, [&](double t) {
    return x[0] * std::exp(-x[1] * t) * std::sin(kTurn * x[2] * t + x[3]) + x[4];
  });
}
/// Magnitudes of two resonances over a band.
Values two_modes(const Values& x) {
  return sampled(80, [&](double s) {
    const double f = 1.0 + 9.0 * s;
    double re = 0.0, im = 0.0;
    for (int k = 0; k < 2; ++k) {
      const double f0 = x[3 * k], zeta = x[3 * k + 1], a = x[3 * k + 2];
      const double p = f0 * f0 - f * f, q = 2.0 * zeta * f0 * f;
      re += a * f0 * f0 * p / (p * p + q * q);
      im -= a * f0 * f0 * q / (p * p + q * q);
    }
    return std::log(std::hypot(re, im));
  });
}
/// Two frequencies with their amplitudes.
Values two_tones(const Values& x) {
  return sampled(80, [&](double t) {
    return x[0] * std::sin(kTurn * x[1] * t) + x[2] * std::sin(kTurn * x[3] * t);
  });
}
/// A bowl with ripple.
Values ripple(const Values& x) {
  Values r;
  for (std::size_t i = 0; i < x.size(); ++i) {
    r.push_back(x[i] + 0.2 * std::sin(2.5 * kTurn * x[i]));
    if (i > 0) r.push_back(x[i] - x[i - 1] + 0.1 * std::sin(1.5 * kTurn * x[i]));
  }
  return r;
}
/// Four tones of known frequencies: phases and amplitudes.
Values phases(const Values& x) {
  return sampled(80, [&](double t) {
    double y = 0.0;
    for (int k = 0; k < 4; ++k) y += std::sin(kTurn * (k + 1.0) * t + x[k]);
    return y * (1.0 + x[4] * t);
  });
}
/// Peaks: place, width, height.
Values peaks(const Values& x, int count) {
  return sampled(70, [&](double s) {
    double y = 0.0;
    for (int k = 0; k < count; ++k) {
      const double z = (s - x[3 * k]) / x[3 * k + 1];
      y += x[3 * k + 2] * std::exp(-0.5 * z * z);
    }
    return y;
  });
}
/// Arms of a chain of two or three links, seen from several angles: several postures.
Values links(const Values& x) {
  Values y;
  double angle = 0.0, px = 0.0, py = 0.0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    angle += x[k];
    px += std::cos(angle);
    py += std::sin(angle);
    if (k % 2 == 1) {
      y.push_back(px);
      y.push_back(py);
    }
  }
  for (const double one : x) y.push_back(0.05 * one);
  return y;
}

std::vector<Range> of_peaks(int count) {
  std::vector<Range> ranges;
  for (int k = 0; k < count; ++k) {
    const std::string of = std::to_string(k + 1);
    ranges.push_back({"place" + of, 0.0, 1.0});
    ranges.push_back({"width" + of, 0.02, 0.08});
    ranges.push_back({"height" + of, 0.3, 2.0});
  }
  return ranges;
}

std::vector<Range> times(int count, const std::string& name, double lower, double upper) {
  std::vector<Range> ranges;
  for (int k = 0; k < count; ++k) ranges.push_back({name + std::to_string(k + 1), lower, upper});
  return ranges;
}

std::vector<Range> of_modes() {
  std::vector<Range> ranges;
  for (int k = 0; k < 2; ++k) {
    const std::string of = std::to_string(k + 1);
    ranges.push_back({"f" + of, 1.0, 10.0});
    ranges.push_back({"zeta" + of, 0.01, 0.1});
    ranges.push_back({"a" + of, 0.2, 2.0});
  }
  return ranges;
}

std::vector<Range> of_phases() {
  auto ranges = times(4, "phase", -3.1, 3.1);
  ranges.push_back({"growth", -0.5, 2.0});
  return ranges;
}

}  // namespace

MultimodalProblem multimodal_problem(int kind, std::uint64_t seed) {
  seed += 100 * static_cast<std::uint64_t>(kind);
  switch (kind) {
    case 0:
      return fitted("frequency", {{"a", 0.3, 3}, {"d", 0, 4}, {"f", 1, 25}}, oscillation, seed);
    case 1:
      return fitted("frequency and phase",
                    {{"a", 0.3, 3}, {"d", 0, 4}, {"f", 1, 20}, {"phase", -3, 3}, {"b", -1, 1}},
                    oscillation_with_phase,
                    seed);
    case 2:
      return fitted("two modes", of_modes(), two_modes, seed);
    case 3:
      return fitted("two tones",
                    {{"a1", 0.5, 2}, {"f1", 1, 16}, {"a2", 0.5, 2}, {"f2", 1, 16}},
                    two_tones,
                    seed);
    case 4:
      return fitted("ripple 4", times(4, "x", -1.0, 1.0), ripple, seed);
    case 5:
      return fitted("ripple 8", times(8, "x", -1.0, 1.0), ripple, seed);
    case 6:
      return fitted("phases", of_phases(), phases, seed);
    case 7:
      return fitted("links 6", times(6, "angle", -2.0, 2.0), links, seed);
    case 8:
      return fitted(
          "one peak", of_peaks(1), [](const Values& x) { return peaks(x, 1); }, seed);
    case 9:
      return fitted(
          "two peaks", of_peaks(2), [](const Values& x) { return peaks(x, 2); }, seed);
    case 10:
      return fitted("links 4", times(4, "angle", -2.5, 2.5), links, seed);
    default:
      return fitted(
          "frequency, few cycles", {{"a", 0.3, 3}, {"d", 0, 2}, {"f", 0.5, 6}}, oscillation, seed);
  }
}

}  // namespace latsch::benchmarks
