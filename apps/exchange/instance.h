// SPDX-License-Identifier: Apache-2.0
// One instance of a functional mock-up unit (FMU) of FMI 2.0 or 3.0: its life cycle and its values,
// for any unit. The C functions of the two standards (fmi2.cpp, fmi3.cpp) call it.
//
//   instantiated ─► initializing ─► stepping ─► terminated
//
// reset() returns from any state to `instantiated`. No function throws: errors are logged and
// become a status. A refused call changes nothing. In the state `initializing` the unit computes
// its initial outputs when an output is read or at the end of the state, and again after every
// change of inputs.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "exchange/unit/model_description.h"
#include "exchange/unit/unit.h"

namespace latsch::exchange {

/// Status values of a call that both standards share.
enum class CallStatus : int { ok = 0, warning = 1, discard = 2, error = 3, fatal = 4 };

class Instance {
 public:
  using Log = std::function<void(CallStatus, const char* category, const std::string& message)>;

  Instance(std::unique_ptr<ExchangedModel> unit, Log log);

  /// Sets the start time and, if there is one, the stop time, s.
  CallStatus set_up(double start, std::optional<double> stop);
  CallStatus begin_initialization();
  CallStatus end_initialization();
  /// Ends the simulation. Logs as warnings the limits of the model that the unit has met; the
  /// status is then `warning`, after which a program may continue, as both standards define it.
  CallStatus terminate();
  CallStatus reset();

  CallStatus get(const unsigned* references, std::size_t count, double* values);
  /// Sets all given values or, on an error, none. Returns `discard` for a value that is not finite.
  CallStatus set(const unsigned* references, std::size_t count, const double* values);
  /// Advances by a step. If the unit has met a limit that is reported at once, logs it and returns
  /// `warning`, once in the life of the instance until reset(); the step is done then.
  CallStatus step(double time, double step);
  double time() const { return now_.time; }

  /// Returns a copy of the whole state of the instance, to be freed by free_state().
  CallStatus copy_state(void** state);
  CallStatus restore_state(void* state);
  static void free_state(void** state);

  /// Logs that the unit lacks a feature; returns `error`.
  CallStatus refuse(const std::string& what);

 private:
  enum class Stage { instantiated, initializing, stepping, terminated };
  struct State {
    std::unique_ptr<ExchangedModel> unit;
    Stage stage = Stage::instantiated;
    double time = 0.0;
    std::optional<double> stop = {};
    bool begun = false;  // true if the outputs are up to date with the inputs

    State copy() const { return {unit->clone(), stage, time, stop, begun}; }
  };

  CallStatus say(CallStatus status, const std::string& message);
  CallStatus guarded(const std::function<CallStatus()>& work);
  CallStatus begin();
  /// Logs the first limit of the unit unless that is done already; returns `warning` if it does.
  CallStatus tell_first_limit();
  std::optional<std::size_t> variable_of(unsigned reference) const;

  State pristine_, now_;
  bool first_limit_told_ = false;
  Log log_;
};

}  // namespace latsch::exchange
