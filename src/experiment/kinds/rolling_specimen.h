// SPDX-License-Identifier: Apache-2.0
// Capabilities of every rolling tire: it rolls, and it stands on the ground with a footprint.
#pragma once

#include <functional>
#include <utility>

#include "base/error.h"
#include "experiment/language/capabilities.h"
#include "experiment/language/known_limits.h"
#include "experiment/language/specimen.h"
#include "models/tire/tared_tire.h"

namespace latsch::experiment {

class RollingSpecimen : public Specimen, public Rolls, public HasFootprint {
 public:
  Result<std::vector<StandingFootprint>> footprints(const FootprintTest& test) override {
    if (test.friction)
      throw InputError(
          "a tire that rolls has friction in its own file: expected a footprint without it");
    const auto prints = experiment::footprints(*tared(tire(test.pressure)), test);
    if (prints)
      for (const StandingFootprint& print : *prints)
        experiment::stood_under(*this, {print.footprint.load});
    return prints;
  }
};

}  // namespace latsch::experiment
