// SPDX-License-Identifier: Apache-2.0
// The files of a co-simulation unit: the folder `resources` of an FMI package, which the package's
// library reads.
//
//   unit.toml    kind = "tire" or "car", token = "{...}"   # hash of the files below
//                [tire] or [car]
//                model_kind, model, road                   # the last two: names of files beside it
//
// A car is one file, with its suspensions and tires as tables (base/document_parts.h).
//
// A new kind of unit is a new line of kUnitKinds.
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

/// Files as pairs of their name in the folder and their bytes.
using UnitFiles = std::vector<std::pair<std::string, std::string>>;

/// Returns a unit of a tire or a car with these parameters on the road of a file (.toml, .crg,
/// .rdf); empty: a flat road at height 0. Throws InputError if the parameters or the road make no
/// unit.
std::unique_ptr<ExchangedModel> unit_of(const experiment::SpecimenKind& kind,
                                        const Document& numbers,
                                        const std::filesystem::path& road = {});
/// Returns the files of a unit, including those that the road's file refers to. `model_text` is the
/// text of the model's file, with the origin of its parameters; empty: a text of the parameters
/// alone.
UnitFiles unit_files(const experiment::SpecimenKind& kind,
                     const Document& numbers,
                     const std::filesystem::path& road = {},
                     const std::string& model_text = "");

/// Returns the token "{...}" that identifies these files; unit.toml contains it.
std::string token_of(const UnitFiles& files);

struct UnitFromFolder {
  std::unique_ptr<ExchangedModel> unit;
  std::string token;
};

/// Reads a unit. Throws InputError that names the file and its error.
UnitFromFolder read_unit(const std::filesystem::path& folder, const experiment::Language& language);

}  // namespace latsch::exchange
