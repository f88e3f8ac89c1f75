// SPDX-License-Identifier: Apache-2.0
// Writes modelDescription.xml of a co-simulation unit, for FMI 2.0 [FMI 2.0.5, 2.2 and 4.3] and FMI
// 3.0 [FMI 3.0.2, 2.4 and 4.4].
//
// The value reference of the time is 0, that of the unit's variable number i is i + 1; these are
// also their positions in ModelVariables, counted from 0. Outputs are those of the last
// communication point and do not follow inputs before the next step: during a step they depend on
// no input, at the start of the unit on all inputs.
#pragma once

#include <string>
#include <vector>

#include "exchange/unit/unit.h"

namespace latsch::exchange {

enum class FmiVersion { fmi2, fmi3 };

/// FMI value reference of the time.
inline constexpr unsigned kTimeReference = 0;
/// Returns the FMI value reference of the unit's variable with this number.
inline constexpr unsigned reference_of(std::size_t variable) {
  return static_cast<unsigned>(variable) + 1;
}

/// Categories of log messages; the model description lists them.
inline constexpr const char* kLogWarning = "logStatusWarning";
inline constexpr const char* kLogDiscard = "logStatusDiscard";
inline constexpr const char* kLogError = "logStatusError";

struct UnitTitle {
  std::string name;         // for people
  std::string description;  // for people
  std::string token;        // guid, instantiationToken
  double step = 1e-3;       // s, step size of the default experiment
};

/// Returns a C identifier made from a name, such as "passenger_205_55R16"; it is the name of the
/// package's binary.
std::string identifier_of(const std::string& name);

std::string model_description(FmiVersion version,
                              const UnitTitle& title,
                              const std::vector<ExchangedVariable>& variables);

}  // namespace latsch::exchange
