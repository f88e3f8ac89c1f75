// SPDX-License-Identifier: Apache-2.0
// Motion of a specimen in the tests of a study, for a page.
#pragma once

#include <vector>

#include "experiment/language/test.h"
#include "report/scene.h"

namespace latsch::experiment {

/// Adds films of the first tests that have one, in a number of steps that keeps a report small; the
/// scene's remarks count the other films. A test in which the specimen fails, or which it cannot
/// run, has no film.
void add_films(const std::vector<const Test*>& tests, Specimen& specimen, report::Scene& scene);

}  // namespace latsch::experiment
