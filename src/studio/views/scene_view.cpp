// SPDX-License-Identifier: Apache-2.0
// The body of a model in space, and its cross section. Drawing takes the time of a trial, so the
// last drawings are stored.
#include <utility>

#include "base/error.h"
#include "correlation/study/variables.h"
#include "report/report.h"
#include "report/scene.h"
#include "studio/views/kept_answers.h"
#include "studio/views/scene_buffer.h"
#include "studio/views/views.h"

namespace latsch::studio {
namespace {

using correlation::Study;

constexpr std::size_t kBodiesKept = 4;

/// Returns the drawing of the model at a design point; the model's kind draws it.
report::StudyReport draw_body(const Study& study, const DesignPoint& point) {
  const experiment::SpecimenKind* kind = study.specimens->kind();
  if (!kind || !kind->has_body()) throw InputError("the model of this study has no body to draw");
  std::vector<const experiment::Test*> tests;
  for (const auto& test : study.tests) tests.push_back(test.test.get());
  report::StudyReport page;
  kind->draw_body(correlation::at(study.model, study.space, point), tests, page);
  return page;
}

std::shared_ptr<const report::StudyReport> drawn_body(const std::shared_ptr<const Study>& study,
                                                      const DesignPoint& point) {
  static KeptAnswers<std::pair<std::shared_ptr<const Study>, std::string>, report::StudyReport>
      kept(kBodiesKept);
  return kept.get({study, point.bits()}, [&] { return draw_body(*study, point); });
}

struct AtPoint {
  std::shared_ptr<const Study> study;
  DesignPoint point;
  std::string words;
};

/// Returns the design point that `trial` names: "initial", "best" (the initial point if there is no
/// best one yet), or the number of a trial.
AtPoint point_of(const ShelvedStudy& shelved, const std::string& trial) {
  return shelved.look([&](const ShelvedStudy::Sight& sight) -> AtPoint {
    if (!sight.study) throw InputError(shelved.id() + " cannot be read: " + sight.error);
    const bool is_best = trial.empty() || trial == "best";
    const auto best = sight.table->best();
    if (trial == "initial" || (is_best && !best))
      return {sight.study, sight.study->space.initial(), "initial values"};
    if (is_best)
      return {sight.study,
              sight.table->rows()[*best].point,
              "best trial, " + std::to_string(*best + 1)};
    const long number = std::atol(trial.c_str());
    if (number < 1 || number > static_cast<long>(sight.table->rows().size()))
      throw InputError("there is no trial \"" + trial + "\"");
    return {sight.study,
            sight.table->rows()[static_cast<std::size_t>(number - 1)].point,
            "trial " + trial};
  });
}

}  // namespace

std::string scene_view(const ShelvedStudy& shelved, const std::string& trial) {
  const AtPoint at = point_of(shelved, trial);
  const auto page = drawn_body(at.study, at.point);
  if (page->scene) return scene_buffer(*page->scene, at.words);
  if (page->pictures) return scene_buffer(report::scene_of(*page->pictures), at.words);
  throw InputError("the model finds no equilibrium at this point: there is nothing to draw");
}

Json section_view(const ShelvedStudy& shelved, const std::string& trial) {
  const AtPoint at = point_of(shelved, trial);
  const auto page = drawn_body(at.study, at.point);
  return page->pictures ? section_of(*page->pictures, at.words) : Json(nullptr);
}

}  // namespace latsch::studio
