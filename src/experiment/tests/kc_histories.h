// SPDX-License-Identifier: Apache-2.0
// Conditions of the tests on K&C rigs: histories of loads, travel and rack, one value for each
// state, either in the file or as recorded, and the regression slopes over one of them. The keys
// are in experiment/tests/keys/kc_histories_keys.cpp.
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
  std::string name, unit;  // SI unit
  /// point of action of a load: W: contact patch, H: wheel center
  std::string frame = "";
};

/// Histories by name, all of one length; only stated quantities.
class Histories {
 public:
  /// Reads the quantities in `loads`, which loads = {from = ...} reads together, and in `others`.
  /// Throws InputError if none is stated; the message then names the load `example` as the key that
  /// was probably intended.
  Histories(const Node& root,
            const TestSource& source,
            const std::vector<Prescribed>& loads,
            const std::vector<Prescribed>& others,
            const char* example);

  std::size_t states() const { return states_; }
  /// Returns nullptr if the quantity is not stated.
  const std::vector<double>* find(const std::string& name) const;
  /// Returns the stated quantities in the order of the lists.
  const std::vector<Prescribed>& stated() const { return stated_; }
  /// Reads slopes_by and window; nullopt if they are not there.
  std::optional<SlopesBy> slopes(const Node& root) const;

 private:
  std::size_t states_ = 0;
  std::vector<Prescribed> stated_;
  std::map<std::string, std::vector<double>> values_;
};

}  // namespace latsch::experiment
