// SPDX-License-Identifier: Apache-2.0
// The body of a model in space and its section. What a kind of model draws takes a trial's time, so
// the last ones are kept.
#include <future>
#include <mutex>

#include "base/error.h"
#include "correlation/study/variables.h"
#include "report/report.h"
#include "report/scene.h"
#include "studio/views/scene_buffer.h"
#include "studio/views/views.h"

namespace latsch::studio {
namespace {

using correlation::Study;

constexpr std::size_t kBodiesKept = 4;

using Body = std::shared_ptr<const report::StudyReport>;

/// What the kind draws of the model at a point.
Body draw_body(const Study& study, const DesignPoint& point) {
  const experiment::SpecimenKind* kind = study.specimens->kind();
  if (!kind || !kind->has_body()) throw InputError("the model of this study has no body to draw");
  std::vector<const experiment::Test*> tests;
  for (const auto& test : study.tests) tests.push_back(test.test.get());
  auto page = std::make_shared<report::StudyReport>();
  kind->draw_body(correlation::at(study.model, study.space, point), tests, *page);
  return page;
}

/// The same, of the last ones as it was; who asks for one that is being drawn waits for it alone.
Body drawn_body(const std::shared_ptr<const Study>& study, const DesignPoint& point) {
  struct Kept {
    std::shared_ptr<const Study> study;
    std::string point;
    std::shared_future<Body> page;
  };
  static std::mutex mutex;
  static std::vector<Kept> kept;
  std::promise<Body> drawn;
  {
    std::unique_lock lock(mutex);
    for (const Kept& one : kept) {
      if (one.study != study || one.point != point.bits()) continue;
      const std::shared_future<Body> page = one.page;
      lock.unlock();
      return page.get();
    }
    if (kept.size() == kBodiesKept) kept.erase(kept.begin());
    kept.push_back({study, point.bits(), drawn.get_future().share()});
  }
  try {
    const Body page = draw_body(*study, point);
    drawn.set_value(page);
    return page;
  } catch (...) {  // for those who wait; the next one draws it again
    drawn.set_exception(std::current_exception());
    const std::lock_guard lock(mutex);
    std::erase_if(kept,
                  [&](const Kept& one) { return one.study == study && one.point == point.bits(); });
    throw;
  }
}

struct AtPoint {
  std::shared_ptr<const Study> study;
  DesignPoint point;
  std::string words;
};

/// "initial", "best", which is the initial point where nothing was found yet, or a trial.
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
  const Body page = drawn_body(at.study, at.point);
  if (page->scene) return scene_buffer(*page->scene, at.words);
  if (page->pictures) return scene_buffer(report::scene_of(*page->pictures), at.words);
  throw InputError("the model finds no equilibrium at this point: there is nothing to draw");
}

Json section_view(const ShelvedStudy& shelved, const std::string& trial) {
  const AtPoint at = point_of(shelved, trial);
  const Body page = drawn_body(at.study, at.point);
  return page->pictures ? section_of(*page->pictures, at.words) : Json(nullptr);
}

}  // namespace latsch::studio
