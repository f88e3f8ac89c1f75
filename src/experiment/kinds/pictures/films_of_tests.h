// SPDX-License-Identifier: Apache-2.0
// Adds the motion of a specimen in the tests of a study to a page, as films.
#pragma once

#include <vector>

#include "experiment/language/test.h"
#include "report/scene.h"

namespace latsch::experiment {

/// Adds films of the first tests that have one, with so few steps that a report stays small; a
/// remark of the scene counts the omitted films. A test in which the specimen fails, or which it
/// cannot run, has no film.
void add_films(const std::vector<const Test*>& tests, Specimen& specimen, report::Scene& scene);

}  // namespace latsch::experiment
