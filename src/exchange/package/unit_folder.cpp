// SPDX-License-Identifier: Apache-2.0
#include "exchange/package/unit_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

#include "base/document_parts.h"
#include "base/error.h"
#include "base/file.h"
#include "base/text.h"
#include "exchange/unit/car_unit.h"
#include "exchange/unit/tire_unit.h"
#include "experiment/language/capabilities.h"
#include "experiment/language/specimen_models.h"
#include "formats/road/road_file.h"
#include "formats/text/document_si.h"
#include "formats/text/teim_orbit_si.h"
#include "formats/tire/tir_file.h"
#include "models/car/rolling_car.h"
#include "models/magic_formula/tree/parameter_tree.h"

namespace latsch::exchange {
namespace {

namespace fs = std::filesystem;

constexpr const char* kModel = "model";
constexpr const char* kFlatRoad = "kind = \"flat\"\n";
constexpr std::size_t kLargestRoad = 256u << 20;  // bytes; the limit for OpenCRG files as well

/// Returns the 64-bit FNV-1a hash of names and contents [Fowler, Noll, Vo; IETF
/// draft-eastlake-fnv].
std::uint64_t hash_of(const UnitFiles& files, std::uint64_t hash) {
  const auto add = [&](std::string_view bytes) {
    for (const char c : bytes) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
    hash = (hash ^ 0xffu) * 0x100000001b3u;  // separates names and contents
  };
  for (const auto& [name, bytes] : files) {
    if (name == kUnitFile) continue;
    add(name);
    add(bytes);
  }
  return hash;
}

std::string hash_in_words(const UnitFiles& files) {
  constexpr std::uint64_t kOffset = 0xcbf29ce484222325u;
  const std::uint64_t a = hash_of(files, kOffset), b = hash_of(files, a ^ kOffset);
  return fmt::format("{{{:08x}-{:04x}-{:04x}-{:04x}-{:012x}}}",
                     a >> 32,
                     (a >> 16) & 0xffff,
                     a & 0xffff,
                     b >> 48,
                     b & 0xffffffffffff);
}

/// Returns the text of a road's file in SI; `named` is the file itself or one that it refers to.
/// OpenCRG has no units but meters and radians.
std::string road_in_si(const fs::path& named, std::string text) {
  const std::string ending = named.extension().string();
  if (ending == ".toml") return formats::text_in_si(Document::parse(text, named.string()));
  if (ending == ".rdf") return formats::with_si_units(text, named.string());
  return text;
}

/// Adds the road's file and the files that it refers to, with names relative to the folder of the
/// road's file.
void add_road(UnitFiles& files, const fs::path& road, bool in_si) {
  formats::read_road_file(road);  // throws InputError if the file is no road
  const fs::path folder = (road.parent_path() / ".").lexically_normal();
  for (const auto& [file, named_in] : formats::references_of_road(road)) {
    const fs::path name = file.lexically_normal().lexically_relative(folder);
    if (name.empty() || *name.begin() == "..")
      throw InputError(named_in,
                       "refers to " + in_quotes(file.string()) +
                           ", which cannot travel with it: expected a file beside or below it");
    const auto same = [&](const auto& there) { return there.first == name.generic_string(); };
    if (std::none_of(files.begin(), files.end(), same)) {
      std::string text = read_text_file(file, kLargestRoad);
      files.emplace_back(name.generic_string(),
                         in_si ? road_in_si(file, std::move(text)) : std::move(text));
    }
  }
}

bool is_car(const experiment::SpecimenKind& kind) { return experiment::can(kind, {Drives::kName}); }

/// Throws InputError unless a unit can be made of such models.
void refuse_other_kinds(const experiment::SpecimenKind& kind) {
  if (!is_car(kind) && !experiment::can(kind, {Rolls::kName}))
    throw InputError("a " + kind.in_words() +
                     " does not roll: expected a tire that does, or a car");
}

bool is_slim_tire(const std::string& kind) {
  return std::ranges::find(slim_tire_kinds(), kind) != slim_tire_kinds().end();
}

/// Returns the numbers of a model's text, which may have other ranges than the model it was written
/// from.
Document numbers_of(const std::string& text, const Document& numbers) {
  if (text.empty()) return numbers;
  if (fs::path(numbers.file()).extension() != ".tir") return Document::parse(text, numbers.file());
  return Document::parse(
      magic_formula::tree_text(formats::parse_tir(text, numbers.file()).parameters),
      numbers.file());
}

/// Throws InputError if a slim library cannot read the model as it was written.
void check_slim(const experiment::SpecimenKind& kind, const std::string& text) {
  const Document written = Document::parse(text, "model.toml");
  if (is_car(kind))
    slim_car(written);
  else
    slim_tire(kind.name(), written);
}

}  // namespace

std::vector<std::string> SpecimenModels::tire_kinds() const {
  return language_->kinds_for({Rolls::kName});
}

RollingModel SpecimenModels::tire(const std::string& kind, const fs::path& file) const {
  const experiment::SpecimenKind& found = *language_->find_kind(kind);
  // a unit in SI has the tree of its numbers in place of a .tir
  const bool is_tree = file.extension() == ".toml" && is_slim_tire(kind);
  return experiment::rolling_model(found.build(is_tree ? Document::read(file) : found.read(file)));
}

DrivingModel SpecimenModels::car(const fs::path& file) const {
  const experiment::SpecimenKind& kind = *language_->find_kind("car");
  return experiment::driving_model(kind.build(kind.read(file)));
}

std::unique_ptr<ExchangedModel> unit_of(const experiment::SpecimenKind& kind,
                                        const Document& numbers,
                                        const fs::path& road) {
  refuse_other_kinds(kind);
  auto surface = road_of_unit(road);
  if (is_car(kind))
    return std::make_unique<CarUnit>(experiment::driving_model(kind.build(numbers)),
                                     std::move(surface));
  return std::make_unique<TireUnit>(experiment::rolling_model(kind.build(numbers)),
                                    std::move(surface));
}

bool is_slim(const experiment::SpecimenKind& kind, const Document& numbers) {
  if (!is_car(kind)) return is_slim_tire(kind.name());
  if (kind.name() != "car") return false;
  for (std::size_t axle = 0; axle < 2; ++axle)
    for (std::size_t side = 0; side < 2; ++side) {
      const std::string key = car::tire_key(axle, side);
      if (!numbers.root().has(key)) continue;
      if (!is_slim_tire(car::tire_kind_name(numbers.root(), part_of(numbers, key), key)))
        return false;
    }
  return true;
}

UnitFiles unit_files(const experiment::SpecimenKind& kind,
                     const Document& numbers,
                     const fs::path& road,
                     const std::string& model_text) {
  // throws for an invalid file; the message then refers to the original file
  unit_of(kind, numbers, road);
  const bool in_si = is_slim(kind, numbers);
  const std::string ending = fs::path(numbers.file()).extension().string();
  const std::string model = kModel + (in_si ? std::string(".toml") : ending);
  UnitFiles files;
  if (in_si) {
    files.emplace_back(model, formats::text_in_si(numbers_of(model_text, numbers)));
    check_slim(kind, files.back().second);
  } else {
    files.emplace_back(model, model_text.empty() ? kind.text(numbers) : model_text);
  }
  if (road.empty()) {
    files.emplace_back("road.toml", kFlatRoad);
  } else {
    add_road(files, road, in_si);
    if (files.back().first == model || files.back().first == kUnitFile)
      throw InputError({road.string(), 0}, "has a name of a file of the unit: give it another");
  }
  const std::string road_name = files[1].first, unit = is_car(kind) ? "car" : "tire";
  if (in_si && !model_text.empty()) files.emplace_back("as_written" + ending, model_text);
  files.emplace_back(kUnitFile,
                     fmt::format("kind = \"{}\"\nformat = {}\ntoken = \"{}\"\n\n[{}]\n"
                                 "model_kind = \"{}\"\nmodel = \"{}\"\nroad = \"{}\"\n",
                                 unit,
                                 in_si ? kUnitFormat : 1,
                                 hash_in_words(files),
                                 unit,
                                 kind.name(),
                                 model,
                                 road_name));
  return files;
}

std::string token_of(const UnitFiles& files) {
  for (const auto& [name, bytes] : files)
    if (name == kUnitFile) return Document::parse(bytes, name).root().text("token");
  throw InputError("there is no unit.toml among the files of the unit");
}

}  // namespace latsch::exchange
