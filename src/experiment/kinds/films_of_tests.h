// SPDX-License-Identifier: Apache-2.0
// How a specimen moves in the tests of a study, for a page.
#pragma once

#include <vector>

#include "experiment/language/test.h"
#include "report/scene.h"

namespace latsch::experiment {

/// Of the first tests that have a film, in so many steps that a report stays small; the scene's
/// remarks say how many others there are. A test in which the specimen fails, or which it cannot
/// do, has none.
void add_films(const std::vector<const Test*>& tests, Specimen& specimen, report::Scene& scene);

}  // namespace latsch::experiment
