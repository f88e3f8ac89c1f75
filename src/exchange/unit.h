// SPDX-License-Identifier: Apache-2.0
// A co-simulation unit: a model that other programs step, seen as a table of numbers. They set
// inputs, ask for a step, read outputs, and may go back to where it was. It knows no file format
// and no C interface (model_description.h, apps/exchange), and these know no model.
//
//   parameters  set before start(), which takes them
//   inputs      what acts on the unit; may be set before every step
//   outputs     what it answers, those of the last start() or step()
//
// All numbers are SI. The state is a value: clone() copies it with all values, and the copy goes on
// to the same bits.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"

namespace latsch::exchange {

enum class Causality { parameter, input, output };

struct Variable {
  std::string name;  // parts joined by points: "wheel.x"
  Causality causality = Causality::output;
  std::string unit;  // one of model_description.h: "N m"; "1": none
  std::string description;
  double start = 0.0;  // of parameters and inputs
};

class Unit {
 public:
  virtual ~Unit() = default;

  /// The same through the unit's life and in its copies. A variable's place in it is its number.
  virtual const std::vector<Variable>& variables() const = 0;
  virtual double value(std::size_t variable) const = 0;
  /// Of a parameter or an input; finite.
  virtual void set(std::size_t variable, double value) = 0;

  /// Begins anew at `time` from parameters and inputs, so that the outputs are those of them.
  /// Nothing, or why there is no such state. InputError where the parameters make no model.
  virtual std::optional<Failure> start(double time) = 0;
  /// From `time` on by `step` > 0, in seconds. After a Failure only a copy from before or start()
  /// goes on.
  virtual std::optional<Failure> step(double time, double step) = 0;

  virtual std::unique_ptr<Unit> clone() const = 0;
};

}  // namespace latsch::exchange
