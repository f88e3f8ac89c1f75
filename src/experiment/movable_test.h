// SPDX-License-Identifier: Apache-2.0
// A test whose numbers can be moved: the settings of a campaign of measurements.
// Implemented in varied_numbers.cpp.
// The numbers are those of the test's keys by their paths, "load" or "states.alpha". A test that
// rolls through a table of measured states has one state instead, whose numbers are the medians of
// the table; of a table that stands in the test itself, the numbers are those of its only state.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/document.h"
#include "experiment/language.h"

namespace latsch::experiment {

/// Keys and folder of a test.
struct TestKeys {
  Node keys;                     // the table [test.NAME], or the root of a file
  std::filesystem::path folder;  // folder of the files that the keys name
};

class MovableTest {
 public:
  /// Takes the keys of a test and the test that was read from them. Throws InputError if the test
  /// takes a condition from a measurement that has no single value, or has several states.
  MovableTest(const TestKeys& keys, const Test& test, const Language& language);

  /// Returns the names of all numbers of the test: the last part of the path if no other number
  /// has it, else the path.
  std::vector<std::string> names() const;
  /// Returns the path of the number with this name or path; nullopt if there is none.
  std::optional<std::string> find(const std::string& name) const;
  /// Returns the value, SI, and the SI unit of the number at a path.
  double value(const std::string& path) const { return keys_.get(path); }
  std::string unit(const std::string& path) const { return keys_.unit(path); }
  /// Sentence on values that were taken from a table of measured states; empty if there are none.
  const std::string& assumed() const { return assumed_; }

  /// Sets the number at a path to an SI value.
  void set(const std::string& path, double value) { keys_.set(path, value); }
  /// Returns the test with its present numbers. Throws InputError if they make none.
  std::unique_ptr<Test> test() const;
  /// Returns the test with its identity. Throws InputError.
  ReadTest identified() const;
  /// Returns the text of a file in this folder that describes the test.
  std::string text(const std::filesystem::path& folder) const;

 private:
  const Language* language_;
  Document keys_;
  std::filesystem::path folder_;
  std::string assumed_;
};

}  // namespace latsch::experiment
