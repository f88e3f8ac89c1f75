// SPDX-License-Identifier: Apache-2.0
// What the tests of K&C rigs state: histories of loads, travel and rack, a value a state, in the
// file or as they were recorded, and the slopes over one of them.
//
//   Fz = ["0 N", "2.5 kN", "5 kN"]       # of every state, or one for all of them
//   Fz = {from = "measurement.rig"}      # its channel Fz; or channel = "left_pad"
//   loads = {from = "measurement.rig"}   # all loads that it recorded, by their names
//   slopes_by = "Fz"                     # adds dz_by_Fz, toe_by_Fz ... (rigs/rig_slopes.h)
//   window = ["1 kN", "4 kN"]            # over the states where Fz is in there
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/document.h"
#include "experiment/language/test.h"
#include "experiment/rigs/rig_slopes.h"

namespace latsch::experiment {

/// A quantity that a rig prescribes.
struct Prescribed {
  std::string name, unit;  // SI
};

/// By name, all of one length; only those that are stated.
class Histories {
 public:
  /// Reads those of `loads` (that loads = {from = ...} takes together) and of `others`. Throws
  /// InputError where none is there: `example`, a load, is what was probably meant.
  Histories(const Node& root,
            const TestSource& source,
            const std::vector<Prescribed>& loads,
            const std::vector<Prescribed>& others,
            const char* example);

  std::size_t states() const { return states_; }
  /// nullptr where it is not stated.
  const std::vector<double>* find(const std::string& name) const;
  /// Those stated, in the order of the lists.
  const std::vector<Prescribed>& stated() const { return stated_; }
  /// slopes_by and window; nullopt where they are not there.
  std::optional<SlopesBy> slopes(const Node& root) const;

 private:
  std::size_t states_ = 0;
  std::vector<Prescribed> stated_;
  std::map<std::string, std::vector<double>> values_;
};

}  // namespace latsch::experiment
