// SPDX-License-Identifier: Apache-2.0
#include "correlation/observable/compared_kinds.h"

namespace latsch::correlation {

extern const ComparedKind kCurveKind, kValuesKind, kFrequencyResponseKind;

const std::vector<const ComparedKind*>& compared_kinds() {
  static const std::vector<const ComparedKind*> kinds = {
      &kCurveKind, &kValuesKind, &kFrequencyResponseKind};
  return kinds;
}

std::vector<std::string> compared_kind_names() {
  std::vector<std::string> names;
  for (const ComparedKind* kind : compared_kinds()) names.push_back(kind->name);
  return names;
}

const ComparedKind* find_compared_kind(const std::string& name) {
  for (const ComparedKind* kind : compared_kinds())
    if (kind->name == name) return kind;
  return nullptr;
}

}  // namespace latsch::correlation
