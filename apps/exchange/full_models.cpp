// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "exchange/loading.h"
#include "exchange/package/unit_folder.h"
#include "experiment/language.h"
#include "experiment/language/capabilities.h"
#include "experiment/language/specimen_models.h"

namespace latsch::exchange {

const UnitModels& models_of_library() {
  static const SpecimenModels models(experiment::language());
  return models;
}

TireFromFolder tire_as_written(const std::filesystem::path& file) {
  const experiment::SpecimenKind& kind = experiment::language().kind_of_file(file);
  const Document numbers = kind.read(file);
  if (!experiment::can(kind, {Rolls::kName}))
    throw InputError({file.string(), 0}, "is a " + kind.in_words() + ", which does not roll");
  return {experiment::rolling_model(kind.build(numbers)), kind.describe(numbers)};
}

}  // namespace latsch::exchange
