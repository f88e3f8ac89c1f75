// SPDX-License-Identifier: Apache-2.0
#include "cli/console/tire_faults.h"

#include "cli/console/console.h"
#include "correlation/analysis/beyond_data.h"

namespace latsch::cli {
void warn_beyond_data(const correlation::Study& study,
                      const DesignPoint& point,
                      const std::string& of_what) {
  for (const std::string& fault : correlation::faults_beyond_data(study, point))
    warn(of_what + fault, {study.file.string(), 0});
}

void warn_beyond_data(const experiment::SpecimenKind& kind,
                      const Document& numbers,
                      const std::string& file) {
  for (const auto& fault : kind.faults_beyond_data(numbers))
    warn(correlation::in_words(fault), {file, 0});
}

}  // namespace latsch::cli
