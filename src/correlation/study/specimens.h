// SPDX-License-Identifier: Apache-2.0
// What makes the specimens of a study: a model whose file holds the numbers that vary, or an
// outside program in its place.
//
//   model = "tire.toml"              # its file says what it is; a .tir is a Magic Formula
//
//   [model]                          # the same, where the file can be read as several kinds
//   kind = "rigid_ring"              # or ring_tire, magic_formula, fe_tire
//   file = "tire.tir"                # beside the study
//
//   [variable.radial]                # a path into the file's numbers, see variables.h; in a .tir
//   path = "sidewall.radial.stiffness"         # the name of the parameter: "PKY1"
//
//   [test.slow]
//   file = "slow.toml"               # a file with a kind of test
//
//   [test.steady]                    # or what would stand in it
//   kind = "steady_states"
//   states = {from = "measurement.cornering"}  # numbers as they were measured; of a key that
//                                              # takes one channel also of another: channel =
//                                              # "drum_speed"
//
//   [experiment.slow_Fz]             # observable/curve.h
//   kind = "curve"
//   x = "slow/time"                  # TEST/CHANNEL
//   y = "slow/Fz"
//   measurement = "slow_measured.csv"
//
// A trial runs the tests that fitted experiments or constraints ask for.
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

/// A test of a study. Its channels are called "NAME/CHANNEL"; those of a test without a name by
/// their own.
struct StudyTest {
  std::string name;
  std::shared_ptr<const experiment::Test> test;
  std::string identity;                           // experiment::ReadTest
  std::vector<std::filesystem::path> files = {};  // that it was read from
  bool is_own = false;                            // of the experiment of the same name

  /// "test slow", "experiment stiffness": as a person finds it in the study.
  std::string in_words() const { return (is_own ? "experiment " : "test ") + name; }
};

class Specimens {
 public:
  virtual ~Specimens() = default;

  /// The specimen at a point. One of another point may hand on its work, see SpecimenKind::build.
  /// InputError where the model does not accept the point.
  virtual std::unique_ptr<experiment::Specimen> at(
      const Study& study,
      const DesignPoint& point,
      std::unique_ptr<experiment::Specimen> reuse = nullptr) const = 0;
  /// InputError where the numbers of the study's model make no specimen.
  virtual void check(const Study& study) const = 0;
  /// The kind of the model; nullptr where an outside program stands in its place.
  virtual const experiment::SpecimenKind* kind() const { return nullptr; }
  /// What the channels of a trial depend on.
  virtual StudyIdentity identity(const Study& study) const = 0;

  /// What stands before the tests and experiments when a study is told, some lines.
  virtual std::string describe(const Study& study) const = 0;
  /// Whether a report may evaluate points once more.
  virtual bool may_repeat() const { return true; }
  /// s, the least of the limits a trial has by itself; 0: none.
  virtual double own_timeout() const { return 0.0; }
  /// Where failed trials leave something behind that goes with the run; empty: nowhere.
  virtual std::filesystem::path leftovers() const { return {}; }
  /// How a person sees more of a failed trial; empty: no way of its own.
  virtual std::string how_to_see_more() const { return ""; }
};

/// The model of a study and its file.
struct StudyModel {
  std::shared_ptr<const Specimens> specimens;
  std::filesystem::path file;  // empty: of an outside program
  Document numbers = Document::parse("", "");
};

/// Of a kind of model; `is_stated`: by the study itself, not by the model's file.
std::shared_ptr<const Specimens> specimens_of(const experiment::SpecimenKind& kind,
                                              bool is_stated = false);

/// Reads `model` or [model]. Throws InputError.
StudyModel read_model(const Node& study,
                      const std::filesystem::path& folder,
                      const experiment::Language& language);

/// Reads every [test.NAME], with conditions from the laboratory. Throws InputError where the kind
/// of the model cannot do it.
std::vector<StudyTest> read_tests(const Node& study,
                                  const std::filesystem::path& folder,
                                  const experiment::SpecimenKind& kind,
                                  const experiment::Language& language,
                                  const Laboratory& laboratory);

/// Why specimens of a kind cannot do a test, with those that can; nullopt where they can.
std::optional<std::string> reason_against(const experiment::SpecimenKind& kind,
                                          const experiment::Test& test,
                                          const experiment::Language& language);

/// The channels of tests, as experiments and constraints name them.
std::vector<KnownChannel> known_channels(const std::vector<StudyTest>& tests);

/// "slow" of "slow/Fz".
std::string test_of(const std::string& channel);

/// The identities of the tests that are asked for, sorted by name: the order in which a study
/// states them does not matter.
std::string identity_of_tests(const std::vector<StudyTest>& tests,
                              const std::vector<std::string>& asked);

}  // namespace latsch::correlation
