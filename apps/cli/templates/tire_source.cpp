// SPDX-License-Identifier: Apache-2.0
#include "cli/templates/tire_source.h"

#include <algorithm>
#include <filesystem>

#include "cli/console/console.h"
#include "correlation/study/variables.h"
#include "correlation/target/best_trial.h"
#include "experiment/language/capabilities.h"

namespace latsch::cli {
namespace {

bool is_study(const std::string& file) {
  if (std::filesystem::path(file).extension() == ".tir") return false;
  const Node root = Document::read(file).root();
  return root.has("model") || root.has("simulator");
}

const experiment::SpecimenKind& kind_of(const std::string& file, const std::string& kind) {
  const experiment::Language& language = experiment::language();
  return kind.empty() ? language.kind_of_file(file) : *language.find_kind(kind);
}

/// The model of a study; InputError where an outside program stands in its place.
ModelSource study_source(const std::string& file) {
  const auto study = correlation::read_study(file);
  if (!study.specimens->kind())
    throw InputError({file, 0},
                     "has a [simulator] in a model's place: there is no tire to show or to write");
  return {study.specimens->kind(), model_of(study)};
}

void expect_mesh(const std::string& file, const experiment::SpecimenKind& kind) {
  const auto abilities = kind.abilities();
  if (std::find(abilities.begin(), abilities.end(), experiment::IsPressed::kName) !=
      abilities.end())
    return;
  throw InputError(
      {file, is_study(file) ? 0 : 1},
      "has a " + kind.in_words() + ", expected a tire of finite elements, which has a mesh");
}

}  // namespace

ModelSource model_source(const std::string& file, const std::string& kind) {
  if (is_study(file)) return study_source(file);
  const experiment::SpecimenKind& of = kind_of(file, kind);
  return {&of, of.read(file)};
}

fe_tire::TireDescription meshed_tire(const std::string& file) {
  if (is_study(file)) {
    const ModelSource source = study_source(file);
    expect_mesh(file, *source.kind);
    return fe_tire::read_tire(source.numbers.root());
  }
  const experiment::SpecimenKind& kind = kind_of(file, "");
  expect_mesh(file, kind);
  return fe_tire::read_tire(kind.read(file).root());
}

Document model_of(const correlation::Study& study) {
  DesignPoint point = study.space.initial();
  if (std::filesystem::exists(study.run.journal)) {
    const auto best = correlation::best_trial(study, Journal::read(study.run.journal));
    if (best) point = best->point;
    say("{} at {}\n", study.title, best ? "its best point" : "its initial values");
  }
  return correlation::at(study.model, study.space, point);
}

}  // namespace latsch::cli
