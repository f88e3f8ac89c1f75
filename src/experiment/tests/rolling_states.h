// SPDX-License-Identifier: Apache-2.0
// The states of the tests in which a finite-element tire rolls: "rolling", "rolling_footprint",
// "rolling_chain". Their keys are those of experiment/tests/keys/rolling_keys.cpp.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "experiment/language/known_limits.h"
#include "experiment/language/test.h"
#include "experiment/rigs/fe_tire/rolling_chain_rig.h"
#include "experiment/rigs/fe_tire/rolling_rig.h"
#include "formats/tables/csv_table.h"

namespace latsch::experiment {

struct RollingStates {
  RollingTest test;
  std::optional<formats::CsvTable> table;  // table of states from a file
};

/// Reads states, friction and pressure. Throws InputError, which names file, line and key.
RollingStates read_rolling_states(const Node& root, const TestSource& source);

/// A test that rolls a finite-element tire through steady states and measures something about them.
class RollsFeTire : public Test, public TellsLimits {
 public:
  explicit RollsFeTire(RollingStates states) : states_(std::move(states)) {}

  std::vector<std::string> needs() const override;
  std::vector<Ledger> ledgers(const std::string& by) const override;
  std::vector<double> driven_at(const std::string& condition) const override;
  Result<Channels> run(Specimen& specimen) const override { return run_with_slopes(specimen, {}); }
  Result<Channels> run_with_slopes(Specimen& specimen, const Asked& asked) const override;
  /// Says which losses a result contains.
  std::vector<std::string> limits(Specimen& specimen) const override;
  Result<std::vector<std::string>> run_in_blocks(
      Specimen& specimen, const std::function<void(const Channels&)>& tell) const override;
  const RollingTest& rolling() const { return states_.test; }
  /// Places of the chains that the test measures; null: it measures none.
  virtual const ChainPlaces* chain_places() const { return nullptr; }

 protected:
  /// Returns "in 3 steady states, friction 1, 2.6 bar".
  std::string states_in_words() const;
  /// Returns the channels of the test's states, with the slopes that are known if `slopes` is not
  /// null.
  virtual Result<Channels> measure(TireRig& rig, fe_tire::TireSlopes* slopes) const = 0;
  RigSettings rig_settings() const override { return &states_.test; }

 private:
  RollingStates states_;
};

}  // namespace latsch::experiment
