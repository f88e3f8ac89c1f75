// SPDX-License-Identifier: Apache-2.0
// A co-simulation unit: a model that other programs step, seen as a table of numbers. These
// programs set inputs, request a step, read outputs, and may return to an earlier state. The unit
// knows no file format and no C interface (model_description.h, apps/exchange), and these know no
// model.
//
//   parameters  set before start(), which reads them
//   inputs      what acts on the unit; may be set before every step
//   outputs     results of the last start() or step()
//
// All numbers are SI. The state is a value: clone() copies it with all values, and the copy
// continues with the same bits.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "base/result.h"

namespace latsch::exchange {

enum class Causality { parameter, input, output };

struct ExchangedVariable {
  std::string name;  // parts joined by points: "wheel.x"
  Causality causality = Causality::output;
  std::string unit;  // a unit of model_description.h: "N m"; "1": none
  std::string description;
  double start = 0.0;  // start value of parameters and inputs
};

class ExchangedModel {
 public:
  virtual ~ExchangedModel() = default;

  /// The table is constant during the unit's life and in its copies. A variable's index in it is
  /// its number.
  virtual const std::vector<ExchangedVariable>& variables() const = 0;
  virtual double value(std::size_t variable) const = 0;
  /// Sets a parameter or an input to a finite value.
  virtual void set(std::size_t variable, double value) = 0;

  /// Starts anew at `time` from parameters and inputs, so that the outputs belong to them. Returns
  /// a Failure if there is no such state. Throws InputError if the parameters make no model.
  virtual Status start(double time) = 0;
  /// Advances from `time` by `step` > 0, in seconds. After a Failure only an earlier copy, or this
  /// unit after start(), can continue.
  virtual Status step(double time, double step) = 0;

  /// Returns a sentence for every limit of the model that was met since the unit was made, such as
  /// a range of the tire's file that it left.
  virtual std::vector<std::string> limits_met() const { return {}; }

  virtual std::unique_ptr<ExchangedModel> clone() const = 0;
};

}  // namespace latsch::exchange
