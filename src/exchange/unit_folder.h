// SPDX-License-Identifier: Apache-2.0
// A unit as files: the `resources` of a package, which its library reads.
//
//   unit.toml    kind = "tire" or "car", token = "{...}"   # of the content of the files below
//                [tire] or [car]
//                model_kind, model, road                   # the last two: names of files beside it
//
// A car is one file, with its suspensions and tires as tables (base/document_parts.h).
//
// A new kind of unit is a line of kUnitKinds.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/document.h"
#include "exchange/unit.h"
#include "experiment/language.h"

namespace latsch::exchange {

/// Files by their names in the folder, with their bytes.
using UnitFiles = std::vector<std::pair<std::string, std::string>>;

/// Returns a tire or a car with these numbers on the road of a file (.toml, .crg, .rdf); empty:
/// flat, height 0. Throws InputError if there is no such unit.
std::unique_ptr<ExchangedModel> unit_of(const experiment::SpecimenKind& kind,
                                        const Document& numbers,
                                        const std::filesystem::path& road = {});
/// Returns the unit as files, including the files that the road's file refers to. `model_text`: the
/// text of the model's file, with the origin of its numbers; empty: the numbers alone.
UnitFiles unit_files(const experiment::SpecimenKind& kind,
                     const Document& numbers,
                     const std::filesystem::path& road = {},
                     const std::string& model_text = "");

/// Returns the token of these files, "{...}", which is that of unit.toml.
std::string token_of(const UnitFiles& files);

struct UnitFromFolder {
  std::unique_ptr<ExchangedModel> unit;
  std::string token;
};

/// Throws InputError naming the file and what is wrong with it.
UnitFromFolder read_unit(const std::filesystem::path& folder, const experiment::Language& language);

}  // namespace latsch::exchange
