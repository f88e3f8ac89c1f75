// SPDX-License-Identifier: Apache-2.0
#include "exchange/loading.h"

namespace latsch::exchange {

const UnitModels& models_of_library() {
  static const SlimModels models;
  return models;
}

}  // namespace latsch::exchange
