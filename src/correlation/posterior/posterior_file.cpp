// SPDX-License-Identifier: Apache-2.0
#include "correlation/posterior/posterior_file.h"

#include <fmt/format.h>

#include <ostream>

#include "base/file.h"
#include "base/units.h"

namespace latsch::correlation {

const char* density_word(const Posterior& posterior) {
  if (!posterior.is_mixed()) return "chains that do not mix";
  if (posterior.method != PosteriorMethod::surrogate) return "model";
  switch (posterior.check.verdict) {
    case SurrogateVerdict::unchecked:
      return "unchecked surrogate";
    case SurrogateVerdict::stands:
      return "surrogate";
    case SurrogateVerdict::doubtful:
      return "doubtful surrogate";
    case SurrogateVerdict::refused:
      break;
  }
  return "refused surrogate";
}

std::filesystem::path samples_file(const Study& study) {
  return std::filesystem::path(study.file).replace_extension(".samples.csv");
}

void write_samples(const Study& study,
                   const Posterior& posterior,
                   const std::filesystem::path& file) {
  write_file(file, [&](std::ostream& out) {
    for (const int axis : posterior.axes)
      out << study.space[axis].name << " [" << study.space[axis].unit << "],";
    out << "log density,chain,density\n";
    for (Eigen::Index k = 0; k < posterior.samples.size(); ++k) {
      const DesignPoint point = posterior.point(study.space, k);
      for (const int axis : posterior.axes)
        out << fmt::format(
            "{:.12g},",
            Unit::of(study.space[axis].unit).from_si(point.values[static_cast<std::size_t>(axis)]));
      out << fmt::format("{:.12g},{},{}\n",
                         posterior.samples.log_density[k],
                         posterior.samples.chain[static_cast<std::size_t>(k)],
                         density_word(posterior));
    }
  });
}

}  // namespace latsch::correlation
