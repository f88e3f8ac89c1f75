// SPDX-License-Identifier: Apache-2.0
// Test support: a study whose forces depend linearly on its variables, so that what its data say of
// them is known in closed form.
//   press   F_k = a x_k + b    at x_k = 5, 10, 15, 20 mm
//   alone   F_k = b + c x_k    at two of them
#pragma once

#include <memory>
#include <vector>

#include "correlation/observable/force_curve.h"
#include "correlation/study/spring_testing.h"

namespace latsch::correlation {

inline const std::vector<double> kPressedAt{0.005, 0.01, 0.015, 0.02}, kAloneAt{0.01, 0.02};

/// The values at which the forces are as measured.
inline const DesignPoint kLinearFit{{4e3, 30.0, 2e3}};

inline std::vector<double> linear_forces(const DesignPoint& p, bool is_alone) {
  std::vector<double> forces;
  for (const double x : is_alone ? kAloneAt : kPressedAt)
    forces.push_back(p.values[1] + p.values[is_alone ? 2 : 0] * x);
  return forces;
}

inline Result<Channels> linear_trial(const DesignPoint& point) {
  Channels channels;
  channels.add({"press/force", "N", linear_forces(point, false)});
  channels.add({"alone/force", "N", linear_forces(point, true)});
  return channels;
}

/// Returns the study with a noise of 5 % of the forces of `press` and 8 % of those of `alone`.
/// `offsets` are added to the measured forces of `press`, N.
inline Study linear_study(const std::vector<double>& offsets = {0.0, 0.0, 0.0, 0.0}) {
  const auto measured = [](const char* test, std::vector<double> x, std::vector<double> forces) {
    return std::make_shared<ForceCurve>(
        test, LoadDeflectionCurve{Abscissa::deflection, std::move(x), std::move(forces), {}});
  };
  std::vector<double> pressed = linear_forces(kLinearFit, false);
  for (std::size_t k = 0; k < pressed.size(); ++k) pressed[k] += offsets[k];
  StudyExperiment press;
  press.name = "press";
  press.observable = measured("press", kPressedAt, pressed);
  press.noise = {.relative = 0.05};
  StudyExperiment alone = press;
  alone.name = "alone";
  alone.observable = measured("alone", kAloneAt, linear_forces(kLinearFit, true));
  alone.noise = {.relative = 0.08};
  Study study{"study.toml",
              "linear springs",
              "springs.toml",
              Document::parse("a = 1", "springs.toml"),
              DesignSpace({{"a", {"a"}, -2e4, 2e4, 4e3},
                           {"b", {"a"}, -3e2, 3e2, 30.0},
                           {"c", {"a"}, -2e4, 2e4, 2e3}}),
              {press, alone},
              {},
              100,
              std::nullopt,
              {}};
  study.specimens = specimens_of(*experiment::spring_language().kinds.front());
  study.target_key = "linear springs";
  return study;
}

}  // namespace latsch::correlation
