// SPDX-License-Identifier: Apache-2.0
// The table of all kinds of specimens and tests; readers, error messages, help and pages are made
// from it. Code receives it as an argument (apps/cli/run_cli.h).
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "experiment/language/specimen.h"
#include "experiment/language/test.h"

namespace latsch::experiment {

struct Language {
  std::vector<const SpecimenKind*> kinds;  // in the order of the documentation
  std::vector<const TestKind*> tests;      // in the order of the documentation

  /// Returns the names of the kinds of specimens: "fe_tire", ...
  std::vector<std::string> kind_names() const;
  /// Returns the names of the kinds of tests: "load_deflection", ...
  std::vector<std::string> test_names() const;
  /// Returns nullptr if no kind has the given name.
  const SpecimenKind* find_kind(const std::string& name) const;
  /// Returns nullptr if no kind of test has the given name.
  const TestKind* find_test(const std::string& name) const;
  /// Returns the kind of a model's file: the `kind` that a TOML file states, else the first kind
  /// that recognizes the file. Throws InputError.
  const SpecimenKind& kind_of_file(const std::filesystem::path& file) const;
  /// Reads the test that a file describes, which states its `kind`. Throws InputError naming the
  /// place.
  std::unique_ptr<Test> read_test(const std::filesystem::path& file,
                                  const MeasuredConditions& measured = nullptr) const;
  /// Reads a test from its keys in any file.
  std::unique_ptr<Test> read_test(const Node& keys, const TestSource& source) const;
  /// Reads a test with its identity, for code that stores recordings.
  ReadTest read_identified_test(const std::filesystem::path& file,
                                const MeasuredConditions& measured = nullptr) const;
  /// Reads a test with its identity from its keys in any file.
  ReadTest read_identified_test(const Node& keys, const TestSource& source) const;
  /// Returns the kinds of specimens that have at least one of these capabilities: "ring_tire", ...
  std::vector<std::string> kinds_for(const std::vector<std::string>& needs) const;
  /// Runs a test with the specimen that these numbers make. Throws InputError if they make none or
  /// the kind cannot run the test.
  Result<Channels> run(const SpecimenKind& kind, const Document& numbers, const Test& test) const;
  /// Runs a test by Test::run_in_blocks().
  Result<std::vector<std::string>> run_in_blocks(
      const SpecimenKind& kind,
      const Document& numbers,
      const Test& test,
      const std::function<void(const Channels&)>& tell) const;
};

/// Returns the language (the models and tests) of the shipped program; other programs may have
/// another one.
const Language& language();

/// True if specimens of this kind have one of these capabilities, or can run the test.
bool can(const SpecimenKind& kind, const std::vector<std::string>& needs);
/// True if specimens of this kind can run the test.
bool can(const SpecimenKind& kind, const Test& test);

}  // namespace latsch::experiment
