// SPDX-License-Identifier: Apache-2.0
// The kinds of experiments that compare channels of a study's tests, or of an outside program, with
// a measurement. A new kind is one file of this folder and its line in compared_kinds.cpp.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/document.h"
#include "correlation/laboratory/measurement.h"
#include "correlation/observable/known_channels.h"
#include "correlation/observable/observable.h"

namespace latsch::experiment {
struct KeySection;
}

namespace latsch::correlation {

struct ComparedKind {
  std::string name;        // kind = "curve" in a study
  bool needs_measurement;  // false: the experiment may contain the measured values itself
  /// Reads the keys of the experiment's table. `measurement` is nullptr if the table has none.
  /// Throws InputError naming the place.
  std::shared_ptr<const Observable> (*read)(const Node& table,
                                            const std::vector<KnownChannel>& channels,
                                            const Measurement* measurement);
  const experiment::KeySection& (*keys)();
};

/// Returns all kinds in the order of the reference.
const std::vector<const ComparedKind*>& compared_kinds();
std::vector<std::string> compared_kind_names();
/// Returns nullptr if no kind has the name.
const ComparedKind* find_compared_kind(const std::string& name);

}  // namespace latsch::correlation
