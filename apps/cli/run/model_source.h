// SPDX-License-Identifier: Apache-2.0
// Finds the model that a verb uses: a model's file as it is, or the model of a study at its best
// point.
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

/// True if the file is a study, with a model or an outside program; false if it is a model.
bool is_study(const std::string& file);

/// Reads a study that has a model. Throws InputError for a study of an outside program.
correlation::Study study_with_model(const std::string& file, const experiment::Language& language);

/// Returns the model of a file: a model's file as it is; a study's model at the best point of its
/// journal, or at the initial values. `kind` is the kind of model as which the file is read; empty:
/// the kind that the file states. Warns of assumptions about the model and of its unusual numbers.
/// Throws InputError for a study of an outside program and for impossible numbers.
ModelSource model_source(const std::string& file,
                         const experiment::Language& language,
                         const std::string& kind = "");

/// Returns the model of a study at the best point of its journal, or at the initial values. Throws
/// InputError if the journal belongs to another study or to an earlier version of this one: a best
/// point found for other numbers or measurements does not apply to this model.
Document model_of(const correlation::Study& study);

}  // namespace latsch::cli
