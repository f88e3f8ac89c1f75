// SPDX-License-Identifier: Apache-2.0
#include "exchange/unit_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>

#include "base/error.h"
#include "base/file.h"
#include "base/text.h"
#include "exchange/car_unit.h"
#include "exchange/tire_unit.h"
#include "formats/road/road_file.h"
#include "models/road/plane_road.h"

namespace latsch::exchange {
namespace {

namespace fs = std::filesystem;

constexpr const char* kUnit = "unit.toml";
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
    if (name == kUnit) continue;
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

/// Adds the road's file and the files that it refers to, with names relative to the folder of the
/// road's file.
void add_road(UnitFiles& files, const fs::path& road) {
  formats::read_road_file(road);  // throws InputError if the file is no road
  const fs::path folder = (road.parent_path() / ".").lexically_normal();
  for (const auto& [file, named_in] : formats::references_of_road(road)) {
    const fs::path name = file.lexically_normal().lexically_relative(folder);
    if (name.empty() || *name.begin() == "..")
      throw InputError(named_in,
                       "refers to " + in_quotes(file.string()) +
                           ", which cannot travel with it: expected a file beside or below it");
    const auto same = [&](const auto& there) { return there.first == name.generic_string(); };
    if (std::none_of(files.begin(), files.end(), same))
      files.emplace_back(name.generic_string(), read_text_file(file, kLargestRoad));
  }
}

/// A kind of unit: its name, and the capability that its models must have.
struct UnitKind {
  const char* name;
  const char* ability;
  std::unique_ptr<ExchangedModel> (*make)(std::shared_ptr<experiment::Specimen>,
                                          std::shared_ptr<const road::Road>);
};

template <class OfThisKind>
std::unique_ptr<ExchangedModel> make(std::shared_ptr<experiment::Specimen> specimen,
                                     std::shared_ptr<const road::Road> road) {
  return std::make_unique<OfThisKind>(std::move(specimen), std::move(road));
}

constexpr std::array kUnitKinds = {UnitKind{"tire", experiment::Rolls::kName, make<TireUnit>},
                                   UnitKind{"car", experiment::Drives::kName, make<CarUnit>}};

const UnitKind& unit_kind_of(const experiment::SpecimenKind& kind) {
  for (const UnitKind& unit : kUnitKinds)
    if (experiment::can(kind, {unit.ability})) return unit;
  throw InputError("a " + kind.in_words() + " does not roll: expected a tire that does, or a car");
}

}  // namespace

std::unique_ptr<ExchangedModel> unit_of(const experiment::SpecimenKind& kind,
                                        const Document& numbers,
                                        const fs::path& road) {
  const UnitKind& unit = unit_kind_of(kind);
  std::shared_ptr<const road::Road> surface;
  if (road.empty()) {
    surface = std::make_shared<road::PlaneRoad>(road::PlaneRoad::Settings{});
  } else {
    surface = formats::read_road_file(road).road;
  }
  return unit.make(kind.build(numbers), std::move(surface));
}

UnitFiles unit_files(const experiment::SpecimenKind& kind,
                     const Document& numbers,
                     const fs::path& road,
                     const std::string& model_text) {
  // throws for an invalid file; the message then refers to the original file
  unit_of(kind, numbers, road);
  UnitFiles files;
  const std::string model = kModel + fs::path(numbers.file()).extension().string();
  files.emplace_back(model, model_text.empty() ? kind.text(numbers) : model_text);
  if (road.empty()) {
    files.emplace_back("road.toml", kFlatRoad);
  } else {
    add_road(files, road);
    if (files.back().first == model || files.back().first == kUnit)
      throw InputError({road.string(), 0}, "has a name of a file of the unit: give it another");
  }
  const std::string road_name = files[1].first, unit = unit_kind_of(kind).name;
  files.emplace_back(kUnit,
                     fmt::format("kind = \"{}\"\ntoken = \"{}\"\n\n[{}]\nmodel_kind = \"{}\"\n"
                                 "model = \"{}\"\nroad = \"{}\"\n",
                                 unit,
                                 hash_in_words(files),
                                 unit,
                                 kind.name(),
                                 model,
                                 road_name));
  return files;
}

std::string token_of(const UnitFiles& files) {
  for (const auto& [name, bytes] : files)
    if (name == kUnit) return Document::parse(bytes, name).root().text("token");
  throw InputError("there is no unit.toml among the files of the unit");
}

UnitFromFolder read_unit(const fs::path& folder, const experiment::Language& language) {
  const Document document = Document::read(folder / kUnit);
  const Node root = document.root();
  std::vector<std::string> names;
  for (const UnitKind& unit : kUnitKinds) names.push_back(unit.name);
  const std::string name = root.choice("kind", names);
  const UnitKind& unit = *std::find_if(
      kUnitKinds.begin(), kUnitKinds.end(), [&](const UnitKind& one) { return one.name == name; });
  UnitFromFolder result;
  result.token = root.text("token");
  const Node keys = root.table(name);
  const experiment::SpecimenKind& kind =
      *language.find_kind(keys.choice("model_kind", language.kinds_for({unit.ability})));
  result.unit = unit_of(kind, kind.read(folder / keys.text("model")), folder / keys.text("road"));
  root.close();
  return result;
}

}  // namespace latsch::exchange
