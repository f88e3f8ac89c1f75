// SPDX-License-Identifier: Apache-2.0
// Software in the loop: an outside program as the model.
//
// A trial has a folder of its own: the input files with the values of the variables, copies of the
// files the program needs, its printed output (printed.txt) and its output files. The program is
// given as an argument list, never a shell line, in which {study} stands for the folder of the
// study. It runs in the process group of its worker, so that the timeout and the memory limit of a
// trial hold for it and for all processes it starts. If the program exceeds a timeout of its own,
// the worker survives. The folder of a trial is removed after the trial, and that of a killed trial
// before the next trial, unless folders of failed trials are to be kept.
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
    std::string file;  // name of the file in the folder of the trial
    InputTemplate text;
  };

  std::filesystem::path study_folder;
  std::filesystem::path scratch;       // folder that contains the folders of trials
  std::vector<std::string> arguments;  // the program and its arguments
  std::vector<Input> inputs;
  /// Files beside the study that are copied into the trial's folder.
  std::vector<std::filesystem::path> copied;
  std::vector<OutputReader> outputs;
  double timeout = 0.0;      // limit for the program alone, s; 0: only the trial's limit holds
  bool keep_failed = false;  // true if folders of failed trials are kept
};

/// Returns the argument list with {study} replaced by the study's folder and {latsch} by this
/// program.
std::vector<std::string> command(const Simulator& simulator);

/// Returns an evaluator of the channels of all outputs. Throws InputError for files that cannot be
/// copied.
Evaluator evaluator(const Simulator& simulator, const DesignSpace& space);

/// Returns the files in the study's folder that are named in the text of a script among the
/// arguments (named_files.h). The channels depend on them, too. The arguments themselves are not
/// included.
std::vector<std::filesystem::path> watched_files(const Simulator& simulator);

/// Returns what the channels depend on: arguments, the content of the program, of every file named
/// by an argument and of watched_files(), inputs, copied files, readers, units.
StudyIdentity identity(const Simulator& simulator, const DesignSpace& space);

}  // namespace latsch
