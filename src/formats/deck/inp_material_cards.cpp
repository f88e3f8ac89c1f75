// SPDX-License-Identifier: Apache-2.0
#include "formats/deck/inp_material_cards.h"

#include <fmt/format.h>

#include <string>
#include <utility>

#include "formats/deck/inp_noted_numbers.h"

namespace latsch::formats {

void InpMaterialCards::material(const InpCard& card) {
  last_ = &deck_.materials[card.option("NAME")];
  last_->name = card.option("NAME");
  last_->place = card.place;
}

InpMaterial& InpMaterialCards::current_material(const InpCard& card) {
  if (!last_)
    throw InputError(card.place, fmt::format("*{} stands before any *MATERIAL", card.keyword));
  return *last_;
}

// Reads the constants of a material law at one temperature. An additional number is that
// temperature and is ignored.
void InpMaterialCards::law(const InpCard& card,
                           InpMaterial::Law law,
                           const std::vector<Constant>& constants) {
  InpMaterial& material = current_material(card);
  if (material.law != InpMaterial::Law::none)
    throw InputError(card.place, fmt::format("a second law of material {}", material.name));
  std::vector<std::pair<const InpLine*, std::size_t>> fields;
  for (const InpLine& line : card.lines)
    for (std::size_t i = 0; i < line.fields.size(); ++i) fields.emplace_back(&line, i);
  if (fields.size() != constants.size() && fields.size() != constants.size() + 1)
    throw InputError(card.place,
                     fmt::format("*{} has {} constants, expected {} at one temperature",
                                 card.keyword,
                                 fields.size(),
                                 constants.size()));
  material.law = law;
  for (std::size_t i = 0; i < constants.size(); ++i)
    material.constants.push_back(
        note_number(deck_,
                    "material." + part_of_path(material.name) + "." + constants[i].name,
                    constants[i].quantity,
                    card,
                    *fields[i].first,
                    fields[i].second));
}

void InpMaterialCards::viscoelastic(const InpCard& card) {
  InpMaterial& material = current_material(card);
  if (card.option("TIME", "") != "PRONY")
    throw InputError(card.place, "*VISCOELASTIC states no Prony terms, expected TIME=PRONY");
  if (!material.relaxation.empty())
    throw InputError(card.place,
                     fmt::format("a second *VISCOELASTIC of material {}", material.name));
  if (card.lines.empty())
    throw InputError(card.place, "*VISCOELASTIC has no rows, expected g, k, tau in each");
  const std::string path = "material." + part_of_path(material.name);
  for (const InpLine& line : card.lines) {
    const std::size_t row = material.relaxation.size() + 1;
    material.relaxation.push_back(
        {note_number(deck_, fmt::format("{}.g{}", path, row), InpQuantity::ratio, card, line, 0),
         note_number(deck_, fmt::format("{}.tau{}", path, row), InpQuantity::time, card, line, 2),
         card.number(line, 1, 0.0),
         card.at(line)});
  }
}

void InpMaterialCards::hyperelastic(const InpCard& card) {
  current_material(card).instantaneous = card.option("MODULI", "") == "INSTANTANEOUS";
  constexpr auto kStress = InpQuantity::stress;
  constexpr Constant kC10{"C10", kStress}, kC01{"C01", kStress}, kD1{"D1", InpQuantity::compliance};
  if (card.has("NEO HOOKE"))
    law(card, InpMaterial::Law::neo_hooke, {kC10, kD1});
  else if (card.has("MOONEY-RIVLIN"))
    law(card, InpMaterial::Law::mooney_rivlin, {kC10, kC01, kD1});
  else
    throw InputError(card.place,
                     "this hyperelastic law is not supported, expected NEO HOOKE or MOONEY-RIVLIN");
}

void InpMaterialCards::elastic(const InpCard& card) {
  current_material(card).instantaneous = card.option("MODULI", "") == "INSTANTANEOUS";
  const auto stresses = [](std::initializer_list<const char*> names) {
    std::vector<Constant> constants;
    for (const char* name : names) constants.push_back({name, InpQuantity::stress});
    return constants;
  };
  const std::string type = card.option("TYPE", "ISO");
  if (type == "ISO" || type == "ISOTROPIC") {
    law(card,
        InpMaterial::Law::isotropic,
        {{"E", InpQuantity::stress}, {"nu", InpQuantity::ratio}});
  } else if (type == "ENGINEERING CONSTANTS") {
    auto constants = stresses({"E1", "E2", "E3", "nu12", "nu13", "nu23", "G12", "G13", "G23"});
    for (std::size_t i = 3; i < 6; ++i) constants[i].quantity = InpQuantity::ratio;
    law(card, InpMaterial::Law::engineering_constants, constants);
  } else if (type == "ORTHO" || type == "ORTHOTROPIC") {
    law(card,
        InpMaterial::Law::orthotropic,
        stresses(
            {"D1111", "D1122", "D2222", "D1133", "D2233", "D3333", "D1212", "D1313", "D2323"}));
  } else if (type == "ANISO" || type == "ANISOTROPIC") {
    law(card,
        InpMaterial::Law::anisotropic,
        stresses({"D1111", "D1122", "D2222", "D1133", "D2233", "D3333", "D1112",
                  "D2212", "D3312", "D1212", "D1113", "D2213", "D3313", "D1213",
                  "D1313", "D1123", "D2223", "D3323", "D1223", "D1323", "D2323"}));
  } else {
    throw InputError(card.place,
                     fmt::format("*ELASTIC, TYPE={} is not supported, expected ISO, ENGINEERING "
                                 "CONSTANTS, ORTHO or ANISO",
                                 type.substr(0, 40)));
  }
}

void InpMaterialCards::density(const InpCard& card) {
  InpMaterial& material = current_material(card);
  std::size_t fields = 0;
  for (const InpLine& line : card.lines) fields += line.fields.size();
  if (card.lines.size() != 1 || fields > 2)
    throw InputError(
        card.place,
        fmt::format("*DENSITY has {} constants, expected 1 at one temperature", fields));
  material.density = note_number(deck_,
                                 "material." + part_of_path(material.name) + ".density",
                                 InpQuantity::density,
                                 card,
                                 card.lines[0],
                                 0);
}

void InpMaterialCards::no_compression(const InpCard& card) {
  current_material(card).no_compression = true;
}

}  // namespace latsch::formats
