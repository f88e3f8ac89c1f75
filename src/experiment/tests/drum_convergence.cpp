// SPDX-License-Identifier: Apache-2.0
#include "experiment/tests/drum_convergence.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "experiment/tests/drum_cleat.h"

namespace latsch::experiment {
namespace {

constexpr std::array kComparedForces = {"Fx", "Fy", "Fz", "Mx", "My", "Mz"};
constexpr const char* kSegments = "belt.nodes";

Result<Channels> run_on_drum(const SpecimenKind& kind,
                             const Document& numbers,
                             const DrumTest& test) {
  return DrumCleatTest(test).run(*kind.build(numbers));
}

double rms(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

double rms_about_mean(std::vector<double> values) {
  double mean = 0.0;
  for (const double value : values) mean += value / static_cast<double>(values.size());
  for (double& value : values) value -= mean;
  return rms(values);
}

double rms_of_difference(std::vector<double> one, const std::vector<double>& other) {
  for (std::size_t i = 0; i < one.size(); ++i) one[i] -= other[i];
  return rms(one);
}

}  // namespace

Result<std::vector<ChannelConvergence>> drum_convergence(const SpecimenKind& kind,
                                                         const Document& numbers,
                                                         const DrumTest& asked) {
  DrumTest test = asked;
  test.frames.resize(1, AxisFrame::C);
  const auto given = run_on_drum(kind, numbers, test);
  if (!given) return given.failure();
  DrumTest half = test;
  half.step *= 0.5;
  const auto halved = run_on_drum(kind, numbers, half);
  if (!halved) return Failure{"with half the step, " + halved.failure().reason};
  std::vector<ChannelConvergence> all;
  for (const char* name : kComparedForces)
    all.push_back({.name = name,
                   .unit = given->find(name)->unit,
                   .about_mean = rms_about_mean((*given)[name]),
                   .by_step = rms_of_difference((*given)[name], (*halved)[name])});
  const auto paths = numbers.paths();
  if (std::find(paths.begin(), paths.end(), kSegments) == paths.end()) return all;
  Document finer = numbers;
  const double segments = std::round(1.5 * numbers.get(kSegments));
  finer.set(kSegments, segments);
  // Passages whose hits are spread over a segment must also be spread over a segment if segments
  // are shorter.
  DrumTest closer = test;
  closer.wheel_step *= numbers.get(kSegments) / segments;
  const auto refined = run_on_drum(kind, finer, closer);
  if (!refined) return Failure{"with half as many segments again, " + refined.failure().reason};
  for (ChannelConvergence& one : all)
    one.by_segments = rms_of_difference((*given)[one.name], (*refined)[one.name]);
  return all;
}

}  // namespace latsch::experiment
