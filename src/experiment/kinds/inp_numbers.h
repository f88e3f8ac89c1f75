// SPDX-License-Identifier: Apache-2.0
// Converts an .inp file of a tire into numbers by path, "material.RUBBER.C10", and back.
//
// The numbers are those of materials, layers of rebars and orientations, and the pressure; the mesh
// stays in the file. `deck` is the hash of the file's text and reveals whether the file has changed
// meanwhile.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/document.h"
#include "formats/mesh/inp_tire.h"

namespace latsch::experiment {

struct InpModel {
  formats::InpDeck deck;  // the deck with the numbers of the document
  formats::InpTire tire;
  std::string text;  // text of the file
};

/// True if the extension of the name is .inp.
bool is_inp(const std::filesystem::path& file);

/// Throws InputError if the file is no tire, or if its densities show that its units are wrong.
Document read_inp_numbers(const std::filesystem::path& file);
/// Returns the assumptions that reading the file has made, one sentence each.
std::vector<std::string> inp_notes(const std::filesystem::path& file);

/// Returns the tire with these numbers. Throws InputError if the file is not the one that the
/// numbers were read from, or if the numbers make no tire.
InpModel inp_model(const Document& numbers);
/// Sets the model's numbers. Returns false, and changes nothing, if the numbers belong to another
/// file.
bool take_numbers(InpModel& model, const Document& numbers);

/// Returns the file's text with these numbers.
std::string inp_text_of(const Document& numbers);

}  // namespace latsch::experiment
