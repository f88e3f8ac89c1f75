// SPDX-License-Identifier: Apache-2.0
// Virtual recordings: a model in place of a laboratory's specimen records a measurement.
//
//   [measurement.loads]
//   file = "measured/loads.csv"                        # latsch run writes it
//   virtual = {model = "tire.toml", test = "pressed"}  # a [test.NAME] of the study, or a file
//
// The first line of the file states its recipe, a fingerprint of the model's numbers and of the
// test, and a fingerprint of the values that follow. A file of another recipe or of other values is
// out of date: `latsch run` records it again, and every other verb refuses it. The version of the
// program is not in the recipe, because a recording is data.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/document.h"
#include "base/result.h"
#include "experiment/language.h"
#include "measurement/channels.h"

namespace latsch::correlation {

/// A recording that a test of a model makes.
struct VirtualRecording {
  std::string name;            // "measurement.loads"
  std::filesystem::path file;  // the file that is written
  std::filesystem::path model_file;
  const experiment::SpecimenKind* kind = nullptr;
  Document numbers = Document::parse("", "");
  std::shared_ptr<const experiment::Test> test;
  std::string test_name;  // its name or file in the study
  std::string recipe;     // fingerprint of model and test

  /// Returns the model and the test in words: "test pressed of tire.toml".
  std::string in_words() const;
};

/// Returns the recordings of every [measurement.NAME] with a key `virtual`. Throws InputError for a
/// model or a test that cannot be read, and for a test that the model cannot undergo.
std::vector<VirtualRecording> virtual_recordings(const std::filesystem::path& study,
                                                 const experiment::Language& language);

/// Returns the text of a recording: a first line that states the recipe and a fingerprint of the
/// table, then the table as CSV.
std::string recording_text(const std::string& in_words,
                           const std::string& recipe,
                           const std::string& table);

/// Clause of a recording whose values are not those that were recorded.
inline constexpr const char* kEdited = "its values have been changed since it was recorded";

/// Returns a clause that says why a file has to be recorded; empty if it is up to date.
std::string why_to_record(const std::filesystem::path& file, const std::string& recipe);

/// Throws InputError that names the command which records them, if a recording of the study is
/// missing or out of date.
void refuse_outdated_recordings(const std::filesystem::path& study,
                                const experiment::Language& language);

/// Runs the test and writes the file. Returns the limits that the model met. A Failure says why the
/// test gave no recording.
Result<std::vector<std::string>> record(const VirtualRecording& recording);

/// Runs a test with the specimen of these numbers. Sets `limits`, unless it is null, to the limits
/// that the model met.
Result<Channels> recorded_channels(const experiment::SpecimenKind& kind,
                                   const Document& numbers,
                                   const experiment::Test& test,
                                   std::vector<std::string>* limits);

}  // namespace latsch::correlation
