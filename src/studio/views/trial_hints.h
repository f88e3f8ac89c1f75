// SPDX-License-Identifier: Apache-2.0
// Explains to a person the cause of a failed trial and what to do about it.
#pragma once

#include <string>

#include "base/result.h"

namespace latsch::studio {

std::string words_of(Cause cause);
std::string hint_for(Cause cause);

}  // namespace latsch::studio
