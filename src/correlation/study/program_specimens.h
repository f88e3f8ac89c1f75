// SPDX-License-Identifier: Apache-2.0
// An outside program in a model's place (simulator_settings.h): a specimen whose numbers are the
// holes of its input files. It has one test, to run it; the test records what it leaves behind.
#pragma once

#include <memory>
#include <vector>

#include "correlation/study/specimens.h"
#include "evaluation/outside_program/simulator.h"

namespace latsch::correlation {

std::shared_ptr<const Specimens> specimens_of(const Simulator& simulator);

/// Channels "OUTPUT/QUANTITY".
StudyTest test_of(const Simulator& simulator);

}  // namespace latsch::correlation
