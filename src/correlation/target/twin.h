// SPDX-License-Identifier: Apache-2.0
// Writes measurements computed by the model itself (a twin), so that a fit has known true values:
// those in the model's file.
#pragma once

#include <filesystem>
#include <vector>

#include "base/result.h"
#include "correlation/study/study.h"

namespace latsch::correlation {

struct TwinFiles {
  std::vector<std::filesystem::path> written;
  struct Kept {
    std::filesystem::path file, as;
  };
  std::vector<Kept> kept;  // measured files, and the names under which they are kept
};

/// Runs every experiment on the model as its file describes it (not at the initial values of the
/// variables) and writes the measurement files the study names, replacing existing ones.
/// Deflections and the number of modes are those of the study file, or of the measurements if these
/// exist. A file in whose place a twin is written for the first time holds measured values, so it
/// is kept under another name: "curve.measured.csv".
Result<TwinFiles> write_twin(const Study& study);

}  // namespace latsch::correlation
