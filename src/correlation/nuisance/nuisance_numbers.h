// SPDX-License-Identifier: Apache-2.0
// Nuisance numbers of a recording, as a study states them: what belongs to the rig and not to the
// model. With y(x) the simulated curve, the recording is
//   (1 + gain) y(x - shift) + offset,
// where the shift is `delay` over time and `x_offset` over any other abscissa. Each number has a
// prior of mean 0 with a stated deviation, or none: "free". Recordings of one rig may share a
// number, which is then stated in a table of its own, [nuisance.NAME] (shared_numbers.h).
//
// The keys are in correlation/nuisance/keys/nuisance_keys.cpp.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/document.h"
#include "correlation/observable/observable.h"

namespace latsch::correlation {

struct NuisanceNumber {
  NuisanceKind kind = NuisanceKind::offset;
  double prior = INFINITY;  // standard deviation, SI; infinite: "free"
  std::string shown = "1";  // unit in which people read the number
  std::string shared = "";  // NAME of its [nuisance.NAME]; empty: the recording's own

  bool is_free() const { return !std::isfinite(prior); }
  bool is_shared() const { return !shared.empty(); }
  /// True if both stand for one number of several recordings.
  bool is_one_with(const NuisanceNumber& other) const {
    return is_shared() && shared == other.shared && kind == other.kind;
  }
  /// Returns "gain", or "gain of [nuisance.cell]" for a shared one.
  std::string name() const;
};

struct Nuisance {
  std::vector<NuisanceNumber> numbers = {};
  /// Values at which the numbers are held, SI, in their order; empty: they are solved.
  std::vector<double> held = {};

  bool empty() const { return numbers.empty(); }
  /// True if the recording shares a number with others, and the numbers are not held.
  bool shares() const;
  /// Returns the position of the shift among the numbers; -1 if there is none.
  int shift() const;
  /// Returns for example "gain 0 +- 2 %, delay free"; empty if there are no numbers.
  std::string in_words() const;
};

/// Reads the table `nuisance` of an experiment. A curve that has a free delay alone solves it
/// itself (curve_delay.h), and nothing is returned for it. `shared` are the tables
/// [nuisance.NAME]. Throws InputError for a number that has no meaning for what the experiment
/// compares, for an experiment that is only predicted, and for a prior beside values whose noise is
/// not known.
Nuisance read_nuisance(const Node& experiment,
                       const std::vector<Node>& shared,
                       const Observable& observable,
                       const ObjectiveSettings& objective,
                       bool is_fitted,
                       bool has_noise);

/// Throws InputError for a number of a table [nuisance.NAME] that no recording names.
void expect_named(const std::vector<Node>& shared, const std::vector<const Nuisance*>& recordings);

/// Returns a value of the number in the unit that people read: "0.83 %", with the digits that the
/// deviation supports.
std::string shown_text(const NuisanceNumber& number, double value, double deviation);

}  // namespace latsch::correlation
