// SPDX-License-Identifier: Apache-2.0
// Origin of a verb's model: a model's file, or a study at its best point.
#pragma once

#include <string>

#include "base/document.h"
#include "correlation/study/study.h"
#include "experiment/language.h"

namespace latsch::cli {

struct ModelSource {
  const experiment::SpecimenKind* kind = nullptr;
  Document numbers = {};
};

/// True if a file is a study, with a model or an outside program; otherwise it is a model.
bool is_study(const std::string& file);

/// Returns a study that has a model. Throws InputError for a study of an outside program.
correlation::Study study_with_model(const std::string& file, const experiment::Language& language);

/// Returns the model of a file: a model's file as it is; a study's model at the best point of its
/// journal, or at the initial values. `kind`: kind as which the file is read; empty: the kind it
/// states. Warns of what was assumed for the model and of its unusual numbers. Throws InputError
/// for a study of an outside program and for numbers that no tire has.
ModelSource model_source(const std::string& file,
                         const experiment::Language& language,
                         const std::string& kind = "");

/// Returns the model of a study at the best point of its journal, or at the initial values. Throws
/// InputError if the journal belongs to another study, or to this one before it was edited, because
/// a best point found for other numbers or measurements does not apply to this model.
Document model_of(const correlation::Study& study);

}  // namespace latsch::cli
