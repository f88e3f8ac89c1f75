// SPDX-License-Identifier: Apache-2.0
// The model of a study: its parameters. On the page a click turns a parameter into a variable.
#include <map>

#include "base/document_tree.h"
#include "base/error.h"
#include "base/file.h"
#include "correlation/study/variables.h"
#include "studio/views/json_values.h"
#include "studio/views/views.h"

namespace latsch::studio {
namespace {

using correlation::Study;

/// Returns for the path of each parameter the variable that changes it, or the dependent quantity
/// that follows a variable.
std::map<std::string, std::string> moved_by(const Study& study) {
  std::map<std::string, std::string> moved;
  for (const DesignVariable& v : study.space.variables()) {
    for (const std::string& path : v.paths) moved[path] = v.name;
    for (const Follower& follower : v.followers)
      for (const std::string& path : follower.paths) moved[path] = v.name;
  }
  return moved;
}

/// Returns the parsed file of the model; nullptr if it is no TOML.
std::unique_ptr<const DocumentTree> tree_of(const Study& study) {
  if (study.model_file.extension() != ".toml") return nullptr;
  return std::make_unique<const DocumentTree>(read_text_file(study.model_file),
                                              study.model_file.string());
}

Json numbers(const Study& study) {
  const auto tree = tree_of(study);
  const auto moved = moved_by(study);
  Json list = Json::array();
  for (const std::string& path : study.model.paths()) {
    const int place = tree ? tree->find(path) : -1;
    const bool has_place = place >= 0 && tree->value(place).number.has_value();
    const std::string unit = has_place ? tree->value(place).number->unit.text() : "";
    const std::string shown = unit.empty() ? study.model.unit(path) : unit;
    const auto variable = moved.find(path);
    list.push_back({{"path", path},
                    {"value", in_unit(study.model.get(path), shown)},
                    {"unit", shown},
                    {"line", has_place ? Json(tree->value(place).line) : Json(nullptr)},
                    {"variable", variable == moved.end() ? "" : variable->second}});
  }
  return list;
}

}  // namespace

Json model_view(const ShelvedStudy& shelved) {
  std::string error;
  const auto study = shelved.look([&](const ShelvedStudy::Sight& sight) {
    error = sight.error;
    return sight.study;
  });
  if (!study) throw InputError(shelved.id() + " cannot be read: " + error);
  const experiment::SpecimenKind* kind = study->specimens->kind();
  Json view{{"file", study->model_file.string()},
            {"kind", kind ? kind->in_words() : "an outside program"},
            {"description", study->specimens->describe(*study)},
            {"numbers", kind ? numbers(*study) : Json::array()},
            {"has_scene", kind && kind->has_body()}};
  return view;
}

}  // namespace latsch::studio
