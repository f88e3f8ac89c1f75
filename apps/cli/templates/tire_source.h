// SPDX-License-Identifier: Apache-2.0
// Where a verb gets a tire from: a tire file, or a study at its best point.
#pragma once

#include <string>

#include "base/document.h"
#include "correlation/study/study.h"

namespace latsch::cli {

/// A tire file as it is; of a study its model at the best point of the journal, or at the initial
/// values.
/// InputError for a study without a tire of finite elements.
Document tire_source(const std::string& file);

/// The model of a study at the best point of its journal, or at the initial values.
Document model_of(const correlation::Study& study);

}  // namespace latsch::cli
