// SPDX-License-Identifier: Apache-2.0
// Explains why a trial failed and what the user can do about it.
#pragma once

#include <string>

#include "base/result.h"

namespace latsch::studio {

std::string words_of(Cause cause);
std::string hint_for(Cause cause);

}  // namespace latsch::studio
