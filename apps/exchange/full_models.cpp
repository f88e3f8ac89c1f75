// SPDX-License-Identifier: Apache-2.0
#include "exchange/loading.h"
#include "exchange/package/unit_folder.h"
#include "experiment/language.h"

namespace latsch::exchange {

const UnitModels& models_of_library() {
  static const SpecimenModels models(experiment::language());
  return models;
}

}  // namespace latsch::exchange
