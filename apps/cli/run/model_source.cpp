// SPDX-License-Identifier: Apache-2.0
#include "cli/run/model_source.h"

#include <fmt/format.h>

#include <filesystem>

#include "base/file.h"
#include "cli/console/console.h"
#include "cli/console/implausible.h"
#include "correlation/search/search_standing.h"
#include "correlation/search/stage_runs.h"
#include "correlation/study/variables.h"
#include "correlation/target/best_trial.h"
#include "experiment/language/kind_files.h"
#include "experiment/language/model_file.h"

namespace latsch::cli {
namespace {

ModelSource study_source(const std::string& file, const experiment::Language& language) {
  const auto study = study_with_model(file, language);
  for (const std::string& note : study.specimens->kind()->notes(study.model_file))
    warn(note, {study.model_file.string(), 0});
  return {study.specimens->kind(), model_of(study)};
}

}  // namespace

correlation::Study study_with_model(const std::string& file, const experiment::Language& language) {
  auto study = correlation::read_study(file, language);
  if (!study.specimens->kind())
    throw InputError(
        {file, 0},
        "has a [simulator] instead of a model, so there is no model to show or to write");
  return study;
}

bool is_study(const std::string& file) {
  expect_no_pipe(file);
  if (!experiment::is_document(file)) return false;
  const Node root = Document::read(file).root();
  return root.has("model") || root.has("simulator");
}

ModelSource model_source(const std::string& file,
                         const experiment::Language& language,
                         const std::string& kind) {
  if (is_study(file)) {
    if (!kind.empty())
      throw InputError({file, 0},
                       "is a study, which states the kind of its model by [model]; expected "
                       "the command without --kind");
    return study_source(file, language);
  }
  const experiment::SpecimenKind& of = kind.empty()
                                           ? language.kind_of_file(file)
                                           : experiment::kind_for_file(kind, file, language.kinds);
  ModelSource source{&of, of.read(file)};
  examine_model(of, source.numbers, file);
  return source;
}

Document model_of(const correlation::Study& study) {
  DesignPoint point = study.space.initial();
  bool is_fitted = false;
  if (std::filesystem::exists(study.run.journal)) {
    const Journal journal = Journal::read(study.run.journal, correlation::identity(study));
    const correlation::Study weighted = correlation::with_estimated_noise(study, journal);
    correlation::require_best(weighted, journal);
    const auto best = correlation::best_trial(weighted, journal);
    if (best) point = best->point;
    is_fitted = best.has_value();
  }
  if (is_fitted)
    say("{} at its best point\n", study.title);
  else
    warn(
        fmt::format("{} has no fitted trial, so its model has the initial values of the variables; "
                    "latsch run fits them",
                    study.title));
  return correlation::at(study.model, study.space, point);
}

}  // namespace latsch::cli
