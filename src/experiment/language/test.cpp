// SPDX-License-Identifier: Apache-2.0
#include "experiment/language/test.h"

namespace latsch::experiment {

Result<std::vector<std::string>> Test::run_in_blocks(
    Specimen& specimen, const std::function<void(const Channels&)>& tell) const {
  const auto all = run(specimen);
  if (!all) return all.failure();
  tell(*all);
  return std::vector<std::string>();
}

}  // namespace latsch::experiment
