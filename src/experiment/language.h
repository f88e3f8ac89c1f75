// SPDX-License-Identifier: Apache-2.0
// All kinds of specimens and tests there are: the one table that readers, errors, help and pages
// take them from. It is handed to them as a value (apps/cli/run_cli.h).
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
  std::vector<const SpecimenKind*> kinds;  // in the order in which people read of them
  std::vector<const TestKind*> tests;

  std::vector<std::string> kind_names() const;
  std::vector<std::string> test_names() const;
  /// nullptr where none is called so.
  const SpecimenKind* find_kind(const std::string& name) const;
  /// Of a model's file alone: the `kind` a TOML file states, else the first that recognizes it.
  /// InputError.
  const SpecimenKind& kind_of_file(const std::filesystem::path& file) const;
  /// The test that a file describes, which states its `kind`. InputError naming the place.
  std::unique_ptr<Test> read_test(const std::filesystem::path& file,
                                  const MeasuredConditions& measured = nullptr) const;
  /// The same of its keys, wherever they stand.
  std::unique_ptr<Test> read_test(const Node& keys, const TestSource& source) const;
  /// The same with its identity, for those who keep recordings.
  ReadTest read_identified_test(const std::filesystem::path& file,
                                const MeasuredConditions& measured = nullptr) const;
  ReadTest read_identified_test(const Node& keys, const TestSource& source) const;
  /// Kinds of specimens that have one of these capabilities, as tests need: "ring_tire", ...
  std::vector<std::string> kinds_for(const std::vector<std::string>& needs) const;
  /// Runs a test with the specimen these numbers make. Throws InputError where they make none or
  /// the kind cannot do it.
  Result<Channels> run(const SpecimenKind& kind, const Document& numbers, const Test& test) const;
  /// The same by Test::run_in_blocks().
  Result<std::vector<std::string>> run_in_blocks(
      const SpecimenKind& kind,
      const Document& numbers,
      const Test& test,
      const std::function<void(const Channels&)>& tell) const;
};

/// What latsch speaks as it is shipped; a program of one's own may speak another.
const Language& language();

/// Whether specimens of this kind have one of these capabilities; whether they can do the test.
bool can(const SpecimenKind& kind, const std::vector<std::string>& needs);
bool can(const SpecimenKind& kind, const Test& test);

}  // namespace latsch::experiment
