// SPDX-License-Identifier: Apache-2.0
#include "experiment/kinds/tire_kind.h"

#include "base/text.h"

namespace latsch::experiment {

extern const TireKind kRingTireKind, kRigidRingKind, kMagicFormulaKind;

const std::vector<const TireKind*>& tire_kinds() {
  static const std::vector<const TireKind*> kinds = {
      &kRingTireKind, &kRigidRingKind, &kMagicFormulaKind};
  return kinds;
}

std::vector<std::string> tire_kind_names() {
  std::vector<std::string> names;
  for (const TireKind* kind : tire_kinds()) names.push_back(kind->name);
  return names;
}

const TireKind* find_tire_kind(const std::string& name) {
  for (const TireKind* kind : tire_kinds()) {
    if (kind->name == name) return kind;
  }
  return nullptr;
}

const TireKind& kind_of_file(const std::filesystem::path& file) {
  if (file.extension() == ".tir") return kMagicFormulaKind;
  const Document document = Document::read(file);
  if (!document.root().has("kind")) {
    throw InputError({file.string(), 0},
                     "does not say what tire it is, expected kind = one of " +
                         list_of(tire_kind_names()) + ", or a .tir file");
  }
  return *find_tire_kind(document.root().choice("kind", tire_kind_names()));
}

}  // namespace latsch::experiment
