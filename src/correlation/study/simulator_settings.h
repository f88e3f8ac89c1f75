// SPDX-License-Identifier: Apache-2.0
// [simulator] in a study, in place of `model`: an outside program evaluates the points.
//
//   [simulator]
//   command = ["python3", "{study}/spring.py", "spring.txt"]   # {study}: folder of the study,
//                                                              # {latsch}: this program
//   inputs = ["spring.txt"]            # templates beside the study, see input_template.h
//   files = ["mesh.inc"]               # copied as they are
//   timeout = "30 s"                   # of the program; [run] has that of the whole trial
//   keep_failed = true                 # folders of failed trials stay in STUDY.scratch
//
//   [simulator.output.response]        # see evaluation/outside_program/output_reader.h
//   file = "response.csv"
//   reader = "table"                   # quantities: names of columns; the file has their units
//   quantities = ["time [s]", "z [mm]"]
//
//   [simulator.output.tip]
//   file = "beam.dat"
//   reader = "pattern"                 # or "columns" with columns = [1, 3], or "keys" with keys =
//   pattern = '^\s*\d+\s+(\S+)\s+(\S+)\s+(\S+)\s*$'   #   ["k"]; unless given, the quantities
//   after = "displacements"
//   quantities = ["ux [mm]", "uy [mm]", "uz [mm]"]
//   samples = 1                        # fewer or more are a failure
//
//   [simulator.output.sweep]           # a TYDEX file: channels and constants by their names
//   file = "sweep.tdx"
//   reader = "tydex"
//   quantities = ["SLIPANGL [deg]", "FYW [N]"]
//
//   [variable.modulus]                 # of such a study: no path, the unit is that of `initial`,
//   lower = "100 GPa"                  # or given: unit = "N/mm^2"
//   upper = "300 GPa"
//   initial = "150 GPa"
#pragma once

#include <filesystem>

#include "base/document.h"
#include "evaluation/outside_program/simulator.h"

namespace latsch::correlation {

/// Reads a variable that stands for holes in input files.
DesignVariable read_free_variable(const Node& table);

/// Reads [simulator]. Also throws InputError for a variable without a hole.
Simulator read_simulator(const Node& table,
                         const std::filesystem::path& study,
                         const DesignSpace& space);

}  // namespace latsch::correlation
