// SPDX-License-Identifier: Apache-2.0
// The body of a model in space and its section. What a kind of model draws takes a trial's time, so
// the last ones are kept.
#include <cstring>
#include <mutex>

#include "base/error.h"
#include "correlation/study/variables.h"
#include "report/scene.h"
#include "report/tire_section.h"
#include "studio/views/json_values.h"
#include "studio/views/recorded_trial.h"
#include "studio/views/views.h"

namespace latsch::studio {
namespace {

using correlation::Study;

constexpr std::size_t kBodiesKept = 4;

using Body = std::shared_ptr<const report::StudyReport>;

/// What the kind draws of the model at a point.
Body drawn_body(const std::shared_ptr<const Study>& study, const DesignPoint& point) {
  struct Kept {
    std::shared_ptr<const Study> study;
    std::string point;
    Body page;
  };
  static std::mutex mutex;
  static std::vector<Kept> kept;
  const std::lock_guard lock(mutex);
  for (const Kept& one : kept)
    if (one.study == study && one.point == point.bits()) return one.page;
  const experiment::SpecimenKind* kind = study->specimens->kind();
  if (!kind || !kind->has_body()) throw InputError("the model of this study has no body to draw");
  std::vector<const experiment::Test*> tests;
  for (const auto& test : study->tests) tests.push_back(test.test.get());
  auto page = std::make_shared<report::StudyReport>();
  kind->draw_body(correlation::at(study->model, study->space, point), tests, *page);
  if (kept.size() == kBodiesKept) kept.erase(kept.begin());
  kept.push_back({study, point.bits(), page});
  return page;
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

/// Numbers of four bytes behind each other, and where each list of them begins.
class Buffer {
 public:
  template <class Number>
  Json add(const std::vector<Number>& numbers) {
    static_assert(sizeof(Number) == 4);
    Json at{{"at", bytes_.size()}, {"count", numbers.size()}};
    const auto* begin = reinterpret_cast<const char*>(numbers.data());
    bytes_.append(begin,
                  numbers.size() * sizeof(Number));  // least significant byte first: x86, ARM
    return at;
  }
  /// The length of the head, the head with blanks up to a multiple of four, the numbers.
  std::string behind(const Json& head) const {
    std::string text = head.dump();
    text.append((4 - text.size() % 4) % 4, ' ');
    const auto length = static_cast<std::uint32_t>(text.size());
    std::string all(sizeof length, '\0');
    std::memcpy(all.data(), &length, sizeof length);
    return all + text + bytes_;
  }

 private:
  std::string bytes_;
};

std::vector<float> millimeters(const Eigen::Matrix3Xd& points) {
  std::vector<float> numbers;
  numbers.reserve(static_cast<std::size_t>(points.size()));
  for (const double x : points.reshaped()) numbers.push_back(static_cast<float>(1e3 * x));
  return numbers;
}

std::string packed(const report::Scene& scene, const std::string& title) {
  Buffer buffer;
  Json head{{"title", title}, {"unit", "mm"}, {"meshes", Json::array()}, {"frames", Json::array()}};
  for (const auto& mesh : scene.meshes) {
    Json parts = Json::array();
    for (const auto& part : mesh.parts)
      parts.push_back({{"name", part.name}, {"first", part.first}, {"count", part.count}});
    head["meshes"].push_back({{"name", mesh.name},
                              {"points", buffer.add(millimeters(mesh.points))},
                              {"triangles", buffer.add(mesh.triangles)},
                              {"edges", buffer.add(mesh.edges)},
                              {"parts", parts}});
  }
  for (const auto& frame : scene.frames) {
    Json field = nullptr;
    if (!frame.field.empty())
      field = {{"name", frame.field_name},
               {"unit", frame.field_unit},
               {"values", buffer.add(frame.field)}};
    head["frames"].push_back(
        {{"name", frame.name},
         {"mesh", frame.mesh},
         {"points", buffer.add(millimeters(frame.points))},
         {"field", field},
         {"swing", frame.swing.cols() == 0 ? Json(nullptr) : buffer.add(millimeters(frame.swing))},
         {"frequency", frame.frequency > 0.0 ? finite(frame.frequency) : Json(nullptr)},
         {"ground", frame.ground ? finite(1e3 * *frame.ground) : Json(nullptr)}});
  }
  return buffer.behind(head);
}

Json section_of(const report::TireSection& section) {
  constexpr double kMillimeter = 1e-3;
  const auto line = [](const std::vector<Eigen::Vector2d>& points) {
    Json y = Json::array(), z = Json::array();
    for (const Eigen::Vector2d& point : points) {
      y.push_back(finite(point.x() / kMillimeter));
      z.push_back(finite(point.y() / kMillimeter));
    }
    return std::pair(y, z);
  };
  Json view{{"unit", "mm"}, {"polygons", Json::array()}, {"cords", Json::array()}};
  for (const auto& polygon : section.polygons) {
    const auto [y, z] = line(polygon.corners);
    view["polygons"].push_back({{"part", polygon.part}, {"y", y}, {"z", z}});
  }
  for (const auto& cord : section.cords) {
    const auto [y, z] = line(cord.corners);
    view["cords"].push_back({{"part", cord.part}, {"y", y}, {"z", z}});
  }
  return view;
}

}  // namespace

std::string scene_view(const ShelvedStudy& shelved, const std::string& trial) {
  const AtPoint at = point_of(shelved, trial);
  const Body page = drawn_body(at.study, at.point);
  if (page->scene) return packed(*page->scene, at.words);
  if (page->pictures) return packed(report::scene_of(*page->pictures), at.words);
  throw InputError("the model finds no equilibrium at this point: there is nothing to draw");
}

Json section_view(const ShelvedStudy& shelved, const std::string& trial) {
  const AtPoint at = point_of(shelved, trial);
  const Body page = drawn_body(at.study, at.point);
  if (!page->pictures) return nullptr;
  Json view = section_of(report::tire_section(*page->pictures));
  view["title"] = at.words;
  return view;
}

}  // namespace latsch::studio
