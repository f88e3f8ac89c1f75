// SPDX-License-Identifier: Apache-2.0
// Whose fault a failed trial is, and what to do about it, for a person.
#pragma once

#include <string>

#include "base/result.h"

namespace latsch::studio {

std::string words_of(Cause cause);
std::string hint_for(Cause cause);

}  // namespace latsch::studio
