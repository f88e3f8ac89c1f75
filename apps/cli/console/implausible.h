// SPDX-License-Identifier: Apache-2.0
// What a study says that no tire is like: before trials are spent on it.
#pragma once

#include "correlation/study/study.h"

namespace latsch::cli {

/// Warns of what is unusual. InputError for what is impossible, the first of it, after warning of
/// all else.
void reject_implausible(const correlation::Study& study);

}  // namespace latsch::cli
