// SPDX-License-Identifier: Apache-2.0
// Implements `latsch export --fmu` and `--sti`: exports a model to programs that simulate the
// system around it.
#pragma once

#include <string>

#include "experiment/language.h"

namespace latsch::cli {

/// A call of `latsch export --fmu`.
struct FmuRequest {
  std::string file;       // the model: a rolling tire, a car, or a study of one
  std::string version;    // "2.0" or "3.0"
  std::string road;       // its file; empty: a flat road
  std::string platforms;  // "linux,windows"; empty: those whose libraries are installed
  std::string output;     // the package
};

/// Writes the FMI package and says for which systems it has a library. Throws InputError, also if
/// the library of a system that was asked for is not installed.
void write_fmu(const FmuRequest& request, const experiment::Language& language);

/// Prints which library and which file a program that uses the Standard Tyre Interface needs. With
/// a folder, writes the tire there in SI, for the library that needs nothing of Latsch. Throws
/// InputError if the library would not accept the file.
void say_sti(const std::string& file,
             const std::string& folder,
             const experiment::Language& language);

}  // namespace latsch::cli
