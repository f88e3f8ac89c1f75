// SPDX-License-Identifier: Apache-2.0
// All keys of a study: the table from which `latsch help study` and docs/study_reference.md are
// written.
#pragma once

#include <string>
#include <vector>

#include "experiment/language.h"
#include "experiment/language/key_section.h"

namespace latsch::correlation {

/// Reads the samples of all sections in a temporary folder and returns what their readers declare,
/// in the order of the reference. Tests are those of the language. Throws InputError if a sample is
/// refused.
experiment::KeyTable read_study_keys(const experiment::Language& language);

}  // namespace latsch::correlation
