// SPDX-License-Identifier: Apache-2.0
// The design of experiments of a study: the points that `latsch doe` evaluates before a fit.
//
// The keys are in correlation/study/keys/doe_keys.cpp.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/document.h"
#include "optimization/design/morris.h"
#include "optimization/design/sampling_plan.h"
#include "optimization/problem/design_space.h"

namespace latsch::correlation {

enum class DesignKind { full_factorial, latin_hypercube, sobol, morris };

struct StudyDesign {
  DesignKind kind = DesignKind::full_factorial;
  /// For a full factorial design: number of levels for each variable; 1: not varied.
  std::vector<int> levels = {};
  int points = 0;  // used by the other designs
  std::uint64_t seed = 0;
  bool asks_shares = false;  // shares of the variance are computed from the points (doe_shares.h)

  /// Returns the name of the design in words, such as "maximin Latin hypercube".
  std::string name() const;
};

/// Reads [doe]. Throws InputError if a key belongs to another design.
StudyDesign read_design(const Node& doe, const DesignSpace& space);

SamplingPlan plan(const StudyDesign& design, const DesignSpace& space);

/// Returns the trajectories of a Morris design, from which its points are made.
MorrisDesign morris_design(const StudyDesign& design, const DesignSpace& space);

}  // namespace latsch::correlation
