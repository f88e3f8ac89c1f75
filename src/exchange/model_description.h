// SPDX-License-Identifier: Apache-2.0
// modelDescription.xml of a co-simulation unit: FMI 2.0 [FMI 2.0.5, 2.2 and 4.3] and FMI 3.0 [FMI
// 3.0.2, 2.4 and 4.4].
//
// The value reference of the time is 0, that of the unit's variable number i is i + 1; these are
// also their positions in ModelVariables, counted from 0. Outputs are those of the last
// communication point and do not follow inputs before the next step: in a step they depend on no
// input, at the start of the unit on all of them.
#pragma once

#include <string>
#include <vector>

#include "exchange/unit.h"

namespace latsch::exchange {

enum class FmiVersion { fmi2, fmi3 };

/// Value reference of the time.
inline constexpr unsigned kTimeReference = 0;
/// Value reference of the unit's variable of this number.
inline constexpr unsigned reference_of(std::size_t variable) {
  return static_cast<unsigned>(variable) + 1;
}

/// Categories of logged messages, which the description lists.
inline constexpr const char* kLogWarning = "logStatusWarning";
inline constexpr const char* kLogDiscard = "logStatusDiscard";
inline constexpr const char* kLogError = "logStatusError";

struct UnitTitle {
  std::string name;         // for people
  std::string description;  // for people
  std::string token;        // guid, instantiationToken
  double step = 1e-3;       // s, of the default experiment
};

/// Returns a C identifier made from a name: "passenger_205_55R16"; the binary of a package has this
/// name.
std::string identifier_of(const std::string& name);

std::string model_description(FmiVersion version,
                              const UnitTitle& title,
                              const std::vector<ExchangedVariable>& variables);

}  // namespace latsch::exchange
