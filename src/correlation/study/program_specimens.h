// SPDX-License-Identifier: Apache-2.0
// An outside program as the model of a study (simulator_settings.h): a specimen whose numbers fill
// the placeholders of its input files. It has one test, which runs the program and records its
// output files.
#pragma once

#include <memory>
#include <vector>

#include "correlation/study/specimens.h"
#include "evaluation/outside_program/simulator.h"

namespace latsch::correlation {

std::shared_ptr<const Specimens> specimens_of(const Simulator& simulator);

/// Returns the test, with channels "OUTPUT/QUANTITY".
StudyTest test_of(const Simulator& simulator);

}  // namespace latsch::correlation
