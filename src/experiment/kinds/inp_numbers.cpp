// SPDX-License-Identifier: Apache-2.0
#include "experiment/kinds/inp_numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

#include "base/file.h"
#include "base/text.h"
#include "formats/mesh/inp_losses.h"
#include "formats/text/letter_case.h"

namespace latsch::experiment {
namespace {

using formats::InpDeck;
using formats::InpNumber;

constexpr std::size_t kLargestDeck = 256u << 20;
// range of the densities of tire materials, kg/m^3
constexpr double kLightest = 300.0, kHeaviest = 2.0e4;

/// Returns the 64-bit FNV-1a hash of a text. It distinguishes texts but does not protect against
/// forgery. [Fowler, Noll, Vo, draft-eastlake-fnv]
std::string fingerprint(std::string_view text) {
  std::uint64_t state = 0xcbf29ce484222325u;
  for (const char byte : text) state = (state ^ static_cast<unsigned char>(byte)) * 0x100000001b3u;
  return fmt::format("{:016x}", state);
}

/// Returns a path as TOML keys of nested tables.
std::string key_of(const std::string& path) {
  std::string key;
  for (std::size_t begin = 0; begin <= path.size();) {
    const std::size_t dot = std::min(path.find('.', begin), path.size());
    key += (key.empty() ? "\"" : ".\"") + path.substr(begin, dot - begin) + "\"";
    begin = dot + 1;
  }
  return key;
}

std::string quantity_text(const InpNumber& number, const formats::InpUnits& units) {
  if (number.quantity == formats::InpQuantity::angle)
    return fmt::format("\"{} deg\"", number.value);
  const double value = to_si(number.value, number.quantity, units);
  if (number.quantity == formats::InpQuantity::ratio) return fmt::format("{}", value);
  return fmt::format("\"{} {}\"", value, unit_of(number.quantity));
}

/// Throws if a density shows that the units are wrong: the tire would be much too heavy or too
/// light.
void check_densities(const InpDeck& deck, const InpModel& model) {
  for (const formats::InpSolid& solid : model.tire.solids) {
    const formats::InpMaterial& material = deck.materials.at(solid.material);
    const double density =
        to_si(deck.value(material.density), formats::InpQuantity::density, deck.units);
    if (density < kLightest || density > kHeaviest)
      throw InputError(
          material.place,
          fmt::format("material {} has a density of {:.3g} kg/m^3 in the units {} ({}), expected "
                      "{:g} to {:g}; a comment such as \"** units: mm, N, tonne\" states others",
                      material.name,
                      density,
                      in_words(deck.units),
                      deck.are_units_stated ? "as stated" : "by the size of the mesh",
                      kLightest,
                      kHeaviest));
  }
}

InpModel model_of(std::string text, const std::string& file) {
  InpModel model;
  model.deck = formats::parse_inp(text, file);
  model.tire = formats::tire_from(model.deck);
  model.text = std::move(text);
  return model;
}

}  // namespace

bool is_inp(const std::filesystem::path& file) {
  return formats::lower(file.extension().string()) == ".inp";
}

Document read_inp_numbers(const std::filesystem::path& file) {
  const InpModel model = model_of(read_text_file(file, kLargestDeck), file.string());
  check_densities(model.deck, model);
  std::string text = fmt::format("deck = \"{}\"\n", fingerprint(model.text));
  for (const InpNumber& number : model.deck.numbers)
    text += key_of(number.path) + " = " + quantity_text(number, model.deck.units) + "\n";
  return Document::parse(text, file.string());
}

std::vector<std::string> inp_notes(const std::filesystem::path& file) {
  const InpDeck deck = formats::read_inp(file);
  std::vector<std::string> notes;
  if (!deck.are_units_stated)
    notes.push_back(
        fmt::format("its units are assumed to be {}, by its size: a comment such as \"** "
                    "units: m, N, kg\" states others",
                    in_words(deck.units)));
  notes.push_back(deck.element_type == "C3D8"
                      ? "its elements C3D8 are computed with full integration, as CalculiX does: "
                        "they lock in bending; as C3D8I they are solid shells"
                      : fmt::format("its elements {} are computed as solid shells, the default of "
                                    "the finite-element tire",
                                    deck.element_type));
  if (deck.element_type != "C3D8" && deck.remarks.walls.empty())
    notes.emplace_back(
        "it states no walls (comments \"** latsch wall:\"): its elements do not correct their "
        "shear by the thickness of the wall; on a coarse 205/55R16 of 14 columns this raises the "
        "growth by 1.6 %, the force by 1.2 % and the lowest mode by 3.8 %, on shorter columns "
        "less");
  const auto relaxes = [](const auto& named) { return !named.second.relaxation.empty(); };
  if (std::ranges::any_of(deck.materials, relaxes))
    notes.emplace_back(
        "its moduli are taken as those of the relaxed materials (MODULI=LONG TERM), and the shares "
        "g of *VISCOELASTIC as those of the instantaneous ones, as in Abaqus; CalculiX knows no "
        "*VISCOELASTIC");
  if (!deck.contacts.empty())
    notes.emplace_back(
        "its ground determines the downward direction and the faces of the tread; a test states "
        "how far the "
        "tire is pressed, stiffness and friction of the ground");
  return notes;
}

InpModel inp_model(const Document& numbers) {
  std::string text = read_text_file(numbers.file(), kLargestDeck);
  if (fingerprint(text) != numbers.root().text("deck"))
    throw InputError({numbers.file(), 0},
                     "was changed after its numbers were read: expected it as it was");
  InpModel model = model_of(std::move(text), numbers.file());
  take_numbers(model, numbers);
  return model;
}

bool take_numbers(InpModel& model, const Document& numbers) {
  if (numbers.file() != model.deck.file || numbers.root().text("deck") != fingerprint(model.text))
    return false;
  for (InpNumber& number : model.deck.numbers) {
    const double si = numbers.get(number.path);
    if (si != to_si(number.value, number.quantity, model.deck.units))
      number.value = from_si(si, number.quantity, model.deck.units);
  }
  model.tire.materials = formats::materials_of(model.tire, model.deck);
  model.tire.losses = formats::losses_of(model.tire, model.deck);
  model.tire.pressure = formats::pressure_of(model.deck);
  return true;
}

std::string inp_text_of(const Document& numbers) {
  const InpModel model = inp_model(numbers);
  return formats::with_numbers_of(model.deck, model.text);
}

}  // namespace latsch::experiment
