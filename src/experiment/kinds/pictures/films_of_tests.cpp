// SPDX-License-Identifier: Apache-2.0
#include "experiment/kinds/pictures/films_of_tests.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"

namespace latsch::experiment {

void add_films(const std::vector<const Test*>& tests, Specimen& specimen, report::Scene& scene) {
  // Largest number of steps of all films together, and largest and least number of one film. More
  // steps make a page larger: a step of a car on its road needs some 7 kB, all of them 1.6 MB,
  // which are 0.9 MB in a report.
  constexpr int kSteps = 240, kMostSteps = 120, kFewestSteps = 9;
  std::vector<const Test*> shown;
  for (const Test* test : tests)
    if (test->has_film()) shown.push_back(test);
  if (shown.empty()) return;
  constexpr std::size_t kMostTests = kSteps / kFewestSteps;
  if (const std::size_t all = shown.size(); all > kMostTests) {
    shown.resize(kMostTests);
    scene.remarks.push_back(
        fmt::format("Of {} tests the first {} are shown step by step; of the other {} the page has "
                    "what was measured and simulated, not how the model moves.",
                    all,
                    kMostTests,
                    all - kMostTests));
  }
  const int steps = std::clamp(kSteps / static_cast<int>(shown.size()), kFewestSteps, kMostSteps);
  for (const Test* test : shown) {
    try {
      // A failure is reported by the trial; the body is drawn nevertheless.
      (void)test->film(specimen, steps, scene);
      // this model cannot run the test, for example a corner without bushings
    } catch (const InputError&) {
    }
  }
}

}  // namespace latsch::experiment
