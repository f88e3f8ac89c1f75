// SPDX-License-Identifier: Apache-2.0
// Creates the specimens of a study: from a model whose file holds the varied numbers, or from an
// outside program.
//
// A trial runs the tests that fitted experiments or constraints need.
//
// The keys are in correlation/study/keys/named_test_keys.cpp.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/document.h"
#include "correlation/laboratory/measurement.h"
#include "correlation/observable/known_channels.h"
#include "evaluation/journal/study_identity.h"
#include "experiment/language.h"
#include "optimization/problem/design_space.h"

namespace latsch::correlation {

struct Study;

/// A test of a study. Its channels are called "NAME/CHANNEL"; a test without a name has the plain
/// names of the channels.
struct StudyTest {
  std::string name;
  std::shared_ptr<const experiment::Test> test;
  std::string identity;                           // copied from experiment::ReadTest
  std::vector<std::filesystem::path> files = {};  // files the test was read from
  /// true if an experiment states the test itself; the test then has the experiment's name
  bool is_own = false;
  bool has_frame_key = false;  // true if its key `frame` chooses the axes of its forces

  /// Returns the words by which a user finds the test in the study: "test slow", "experiment
  /// stiffness".
  std::string in_words() const { return (is_own ? "experiment " : "test ") + name; }
};

class Specimens {
 public:
  virtual ~Specimens() = default;

  /// Returns the specimen at a point. `reuse` is a specimen of another point whose work may be
  /// reused (SpecimenKind::build). Throws InputError if the model does not accept the point.
  virtual std::unique_ptr<experiment::Specimen> at(
      const Study& study,
      const DesignPoint& point,
      std::unique_ptr<experiment::Specimen> reuse = nullptr) const = 0;
  /// Throws InputError if the numbers of the study's model make no specimen.
  virtual void check(const Study& study) const = 0;
  /// Returns the kind of the model; nullptr for an outside program.
  virtual const experiment::SpecimenKind* kind() const { return nullptr; }
  /// Returns the identity of everything on which the channels of a trial depend.
  virtual StudyIdentity identity(const Study& study) const = 0;

  /// Returns the lines that precede the tests and experiments in a printed study.
  virtual std::string describe(const Study& study) const = 0;
  /// True if a report may evaluate points again.
  virtual bool may_repeat() const { return true; }
  /// Returns the least time limit that the model itself sets for a trial, s; 0: none.
  virtual double own_timeout() const { return 0.0; }
  /// Returns the folder in which failed trials leave files; empty: none.
  virtual std::filesystem::path leftovers() const { return {}; }
  /// Returns advice on how to find out more about a failed trial; empty: none.
  virtual std::string how_to_see_more() const { return ""; }
};

/// The model of a study and its file.
struct StudyModel {
  std::shared_ptr<const Specimens> specimens;
  std::filesystem::path file;  // empty for an outside program
  Document numbers = Document::parse("", "");
};

/// Returns the specimens of a kind of model. `is_stated` is true if the study states the kind, not
/// the model's file.
std::shared_ptr<const Specimens> specimens_of(const experiment::SpecimenKind& kind,
                                              bool is_stated = false);

/// Reads the key `model` or the table [model]. Throws InputError.
StudyModel read_model(const Node& study,
                      const std::filesystem::path& folder,
                      const experiment::Language& language);

/// Reads every [test.NAME], with conditions from the laboratory. Throws InputError if models of the
/// kind cannot run it.
std::vector<StudyTest> read_tests(const Node& study,
                                  const std::filesystem::path& folder,
                                  const experiment::SpecimenKind& kind,
                                  const experiment::Language& language,
                                  const Laboratory& laboratory);

/// Returns a sentence that says why specimens of a kind cannot run a test, and which kinds can;
/// nullopt if they can.
std::optional<std::string> reason_against(const experiment::SpecimenKind& kind,
                                          const experiment::Test& test,
                                          const experiment::Language& language);

/// Returns the channels of tests under the names that experiments and constraints use.
std::vector<KnownChannel> known_channels(const std::vector<StudyTest>& tests);

/// Returns the name of the test of a channel: "slow" for "slow/Fz".
std::string test_of(const std::string& channel);

/// Returns the identities of the tests in `asked`, sorted by name, so that their order in the study
/// does not matter.
std::string identity_of_tests(const std::vector<StudyTest>& tests,
                              const std::vector<std::string>& asked);

}  // namespace latsch::correlation
