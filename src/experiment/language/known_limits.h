// SPDX-License-Identifier: Apache-2.0
// Limits of a tire model on an obstacle, told beside the result of a test and before a study runs
// it.
#pragma once

#include <string>
#include <vector>

#include "experiment/language/specimen.h"
#include "experiment/rigs/cleat.h"

namespace latsch::experiment {

/// A specimen that knows limits of its model.
struct KnowsLimits {
  virtual ~KnowsLimits() = default;
  /// Returns a sentence for every limit that matters on this cleat; empty if none does.
  virtual std::vector<std::string> limits_on(const Cleat& cleat) const = 0;
  /// A sentence for every limit that counts on a road whose height differs across the width of the
  /// tire; empty: none does.
  virtual std::vector<std::string> limits_across() const { return {}; }
};

/// A test that knows when such a limit counts in it.
struct TellsLimits {
  virtual ~TellsLimits() = default;
  /// A sentence for every limit of the specimen that counts in this test, without running it.
  virtual std::vector<std::string> limits(Specimen& specimen) const = 0;
};

/// Angle of a cleat, rad, below which it acts like a straight cleat over the tire's width.
constexpr double kStraightCleat = 0.02;

/// Returns the limits of a specimen on a test's cleat; empty if the specimen knows no limits or the
/// test has no cleat.
template <class Specimen>
std::vector<std::string> limits_of(Specimen& specimen, const std::optional<Cleat>& cleat) {
  const auto* knows = specimen.template find<KnowsLimits>();
  return knows && cleat ? knows->limits_on(*cleat) : std::vector<std::string>();
}

}  // namespace latsch::experiment
