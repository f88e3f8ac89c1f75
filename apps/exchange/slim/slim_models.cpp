// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "exchange/loading.h"

namespace latsch::exchange {

const UnitModels& models_of_library() {
  static const SlimModels models;
  return models;
}

TireFromFolder tire_as_written(const std::filesystem::path& file) {
  throw InputError({file.string(), 0},
                   "is not the unit.toml of a folder in SI, which this library reads alone: write "
                   "one by latsch export TIRE --sti -o FOLDER, and name FOLDER/unit.toml");
}

}  // namespace latsch::exchange
