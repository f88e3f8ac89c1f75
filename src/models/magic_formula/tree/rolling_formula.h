// SPDX-License-Identifier: Apache-2.0
// The Magic Formula of a tree of numbers as a model that rolls. Its tires record their inputs in
// one log, so that the model knows which ranges of its file they left.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/document.h"
#include "models/magic_formula/magic_formula_tire.h"
#include "models/tire/rolls.h"

namespace latsch::magic_formula {

/// Returns a sentence on why a pressure has no effect on the tire.
std::string no_pressure_in_words();

class RollingFormula final : public Rolls, public MeetsLimits {
 public:
  /// Throws InputError as parameters_of() does.
  explicit RollingFormula(const Document& numbers);

  std::unique_ptr<Tire> tire(const Inflation& pressure = {}) const override;
  /// Returns a sentence for each range of the file that a tire has left, for each value that is
  /// assumed for a wheel that hardly rolls, and one if the last pressure stated has no effect.
  std::vector<std::string> limits_met() const override;

  const Parameters& parameters() const { return parameters_; }
  /// The file of the numbers, for messages.
  const std::string& file() const { return file_; }
  /// Returns the settings of a tire under this pressure, which is remembered for limits_met().
  /// Throws InputError if the tire has no vertical stiffness there: its factor 1 + PFZ1 dpi is 0 or
  /// negative.
  MagicFormulaTireSettings settings_at(const Inflation& pressure) const;
  /// Throws InputError if the tire has no vertical stiffness at this pressure, Pa.
  void refuse_soft_pressure(double pressure, const Place& place) const;
  /// Records a load, N, under which a tire of this model stood.
  void stood_under(double load) { log_->add_standing(load); }

 private:
  Parameters parameters_;
  std::string file_;
  std::shared_ptr<RangeLog> log_ = std::make_shared<RangeLog>();
  mutable Inflation asked_pressure_;  // the last one that was stated
};

}  // namespace latsch::magic_formula
