// SPDX-License-Identifier: Apache-2.0
#include "experiment/language/model_file.h"

#include "formats/text/letter_case.h"

namespace latsch::experiment {

bool is_document(const std::filesystem::path& file) {
  const std::string ending = formats::lower(file.extension().string());
  return ending != ".tir" && ending != ".inp";
}

}  // namespace latsch::experiment
