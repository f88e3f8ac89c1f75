// SPDX-License-Identifier: Apache-2.0
// The interface of a co-simulation unit: a model that other programs advance step by step, seen as
// a table of numbers. These programs set inputs, request a step, read outputs, and may return to an
// earlier state. A unit knows no file format and no C interface (model_description.h,
// apps/exchange), and these know no model.
//
//   parameters  set before start(), which reads them
//   inputs      quantities that act on the unit; may be set before every step
//   outputs     results of the last start() or step()
//
// All numbers are in SI. clone() copies a unit with its state and all values, and the copy
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
  std::string name;  // name of parts separated by dots: "wheel.x"
  Causality causality = Causality::output;
  std::string unit;  // a unit that model_description.h knows: "N m"; "1" for a plain number
  std::string description;
  double start = 0.0;  // start value of a parameter or an input
};

class ExchangedModel {
 public:
  virtual ~ExchangedModel() = default;

  /// Returns the table of variables. It is constant during the life of the unit and in its copies;
  /// the index of a variable in it is the variable's number.
  virtual const std::vector<ExchangedVariable>& variables() const = 0;
  virtual double value(std::size_t variable) const = 0;
  /// Sets a parameter or an input; the value must be finite.
  virtual void set(std::size_t variable, double value) = 0;

  /// Starts at `time`, s, from the parameters and inputs; the outputs are then up to date. Returns
  /// a Failure if there is no such state. Throws InputError if the parameters do not define a
  /// model.
  virtual Status start(double time) = 0;
  /// Advances from `time` by `step` > 0, s. After a Failure only an earlier copy, or this unit
  /// after start(), can continue.
  virtual Status step(double time, double step) = 0;

  /// Returns a sentence for every limit of the model that was met since the unit was created, such
  /// as a validity range of the tire's file that it left.
  virtual std::vector<std::string> limits_met() const { return {}; }

  /// Returns a sentence on a limit that the program which steps the unit should report at once,
  /// with the time at which the unit first met it on the way to its present state; empty if it met
  /// none.
  virtual std::string first_limit() const { return {}; }

  virtual std::unique_ptr<ExchangedModel> clone() const = 0;
};

}  // namespace latsch::exchange
