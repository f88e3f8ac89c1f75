// SPDX-License-Identifier: Apache-2.0
// Writes the files of a co-simulation unit, which unit_reading.h describes: the folder `resources`
// of an FMI package.
//
// A unit that a slim library can make is written in SI (format 2). A unit with finite elements, or
// of an outside kind of model, keeps its files as they are (format 1) and needs the library with
// all models.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/document.h"
#include "exchange/unit/unit.h"
#include "exchange/unit/unit_models.h"
#include "exchange/unit/unit_reading.h"
#include "experiment/language.h"

namespace latsch::exchange {

/// Files as pairs of their name in the folder and their bytes.
using UnitFiles = std::vector<std::pair<std::string, std::string>>;

/// All models of the program, from files with any units.
class SpecimenModels final : public UnitModels {
 public:
  explicit SpecimenModels(const experiment::Language& language) : language_(&language) {}
  std::vector<std::string> tire_kinds() const override;
  bool reads_any_units() const override { return true; }
  RollingModel tire(const std::string& kind, const std::filesystem::path& file) const override;
  DrivingModel car(const std::filesystem::path& file) const override;

 private:
  const experiment::Language* language_;
};

/// Returns a unit of a tire or a car with these parameters on the road of a file (.toml, .crg,
/// .rdf); empty: a flat road at height 0. Throws InputError if the parameters or the road make no
/// unit.
std::unique_ptr<ExchangedModel> unit_of(const experiment::SpecimenKind& kind,
                                        const Document& numbers,
                                        const std::filesystem::path& road = {});

/// Returns true if a slim library can make the unit of these parameters.
bool is_slim(const experiment::SpecimenKind& kind, const Document& numbers);

/// Returns the files of a unit, including those that the road's file refers to. `model_text` is the
/// text of the model's file, with the origin of its parameters; empty: a text of the parameters
/// alone. Beside the model in SI, a given text is kept as the file "as_written" with the ending of
/// the model's file.
UnitFiles unit_files(const experiment::SpecimenKind& kind,
                     const Document& numbers,
                     const std::filesystem::path& road = {},
                     const std::string& model_text = "");

/// Returns the token "{...}" that identifies these files; unit.toml contains it.
std::string token_of(const UnitFiles& files);

}  // namespace latsch::exchange
