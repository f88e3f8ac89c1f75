// SPDX-License-Identifier: Apache-2.0
#include "cli/templates/tire_source.h"

#include <fmt/format.h>

#include <filesystem>

#include "cli/console/console.h"
#include "correlation/study/study.h"
#include "correlation/study/variables.h"
#include "correlation/target/best_trial.h"

namespace latsch::cli {

Document tire_source(const std::string& file) {
  Document document = Document::read(file);
  if (document.root().has("simulator")) {
    throw InputError({file, 0},
                     "has a [simulator] in a model's place: there is no tire to show or to write");
  }
  if (!document.root().has("model")) return document;
  const auto study = correlation::read_study(file);
  if (study.rolling) {
    throw InputError({file, 0},
                     "has a " + study.rolling->kind->in_words +
                         ", expected a tire of finite elements, which has a mesh");
  }
  return model_of(study);
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
