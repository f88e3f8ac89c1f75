// SPDX-License-Identifier: Apache-2.0
// Endings of the files of each kind of model: .tir, .inp, .toml.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "experiment/language/specimen.h"

namespace latsch::experiment {

/// Returns the reason why a file with this extension is no model of the kind, in words that follow
/// the file's name: "is a .tir file, which is no flexible ring; expected kind = magic_formula or
/// rigid_ring". Returns nothing if the extension fits the kind or says nothing about the contents.
std::optional<std::string> reason_against_ending(const SpecimenKind& kind,
                                                 const std::filesystem::path& file,
                                                 const std::vector<const SpecimenKind*>& kinds);

/// Returns the kind with this name. Throws InputError if the file has the ending of another kind.
const SpecimenKind& kind_for_file(const std::string& name,
                                  const std::filesystem::path& file,
                                  const std::vector<const SpecimenKind*>& kinds);

/// Throws InputError if a model of the kind, written to this file, could not be read again.
void expect_own_ending(const SpecimenKind& kind, const std::filesystem::path& file);

}  // namespace latsch::experiment
