// SPDX-License-Identifier: Apache-2.0
// Software in the loop: an outside program in a model's place.
//
// A trial has a folder of its own: the input files with the values of the variables, copies of the
// files the program needs, what it prints (printed.txt) and what it leaves behind. The program is
// an argument list, never a shell line, with {study} for the folder of the study; it runs in the
// process group of its worker, so that the timeout and the memory limit of a trial hold for it and
// for all it starts. A timeout of its own spares the worker. The folder is removed after the trial,
// that of a trial that was killed before the next one, except where failed ones are to be kept.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "evaluation/journal/study_identity.h"
#include "evaluation/outside_program/input_template.h"
#include "evaluation/outside_program/output_reader.h"
#include "evaluation/trial/evaluator.h"

namespace latsch {

struct Simulator {
  struct Input {
    std::string file;  // in the folder of the trial
    InputTemplate text;
  };

  std::filesystem::path study_folder;
  std::filesystem::path scratch;       // folders of trials are made in here
  std::vector<std::string> arguments;  // the program and what follows it
  std::vector<Input> inputs;
  std::vector<std::filesystem::path> copied;  // files beside the study
  std::vector<OutputReader> outputs;
  double timeout = 0.0;      // s, of the program alone; 0: that of the trial only
  bool keep_failed = false;  // folders of trials that failed
};

/// The argument list with the folder of the study in the place of {study} and this program itself
/// in that of {latsch}.
std::vector<std::string> command(const Simulator& simulator);

/// The channels of all outputs. Throws InputError for files that cannot be copied.
Evaluator evaluator(const Simulator& simulator, const DesignSpace& space);

/// What its channels depend on: arguments, the program among them and every file they name by its
/// content, inputs, copied files, readers, units.
StudyIdentity identity(const Simulator& simulator, const DesignSpace& space);

}  // namespace latsch
