// SPDX-License-Identifier: Apache-2.0
// The optimization methods: their names, how each is read from a table of a study, and how it is
// created. A new method consists of its own files, its name and options in optimizer_choice.h, and
// one entry in method_kinds.cpp.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/document.h"
#include "optimization/strategy/optimizer_choice.h"

namespace latsch {

/// A key that a method reads. If several methods have a key with the same meaning, `sentence` is
/// empty, and the reference of a study describes the key once
/// (correlation/study/keys/optimizer_keys.cpp).
struct MethodKey {
  std::string name;
  std::string example;         // TOML value
  std::string sentence = "";   // meaning of the key, in Markdown
  std::string otherwise = "";  // default in words, if it is not a plain value
  std::string range = "";      // range in words, if it depends on other values
};

struct MethodKind {
  Method method;
  std::string_view name, words;  // name in a study, and words in a report
  bool knows_nonlinear;          // supports nonlinear constraints; all methods support linear ones
  std::vector<MethodKey> keys;
  /// Reads these keys into the settings. Throws InputError naming the place. The pointer is nullptr
  /// for a method that combines other methods: the caller then reads their tables.
  void (*read)(const Node& table, OptimizerSettings& settings);
  std::unique_ptr<Optimizer> (*make)(const DesignSpace& space,
                                     const OptimizerSettings& settings,
                                     const ProblemTraits& traits);
};

/// Returns all methods in the order in which they are offered.
const std::vector<MethodKind>& method_kinds();
const MethodKind& kind_of(Method method);

}  // namespace latsch
