// SPDX-License-Identifier: Apache-2.0
#include "correlation/search/study_change.h"

#include "base/error.h"

namespace latsch::correlation {

std::optional<std::string> change_since_read(const Study& study,
                                             const experiment::Language& language) {
  try {
    const Study now = read_study(study.file, language);
    if (const auto what = difference(identity(study), identity(now))) return what;
    if (now.search_key != study.search_key)
      return "its variables, experiments, measurements or search have changed";
    return std::nullopt;
  } catch (const InputError& error) {
    return std::string("it cannot be read any more: ") + error.what();
  }
}

}  // namespace latsch::correlation
