// SPDX-License-Identifier: Apache-2.0
// An .inp file of a tire as numbers by path, "material.RUBBER.C10", and back.
//
// The numbers are those of materials, layers of rebars and orientations, and the pressure; the mesh
// stays in the file. `deck` is the hash of its text, by which a file that was changed meanwhile is
// found out.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/document.h"
#include "formats/mesh/inp_tire.h"

namespace latsch::experiment {

struct InpModel {
  formats::InpDeck deck;  // its numbers are those of the document
  formats::InpTire tire;
  std::string text;  // of the file
};

/// By the ending of the name.
bool is_inp(const std::filesystem::path& file);

/// InputError where the file is no tire, or where its densities say that its units are others.
Document read_inp_numbers(const std::filesystem::path& file);
/// What was assumed for the file, a sentence each.
std::vector<std::string> inp_notes(const std::filesystem::path& file);

/// The tire with these numbers. InputError where the file is another than the one they were read
/// from, or the numbers make no tire.
InpModel inp_model(const Document& numbers);
/// Whether these are numbers of the same file; the model then has them.
bool take_numbers(InpModel& model, const Document& numbers);

/// The file with these numbers.
std::string inp_text_of(const Document& numbers);

}  // namespace latsch::experiment
