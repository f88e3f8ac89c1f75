// SPDX-License-Identifier: Apache-2.0
#include "formats/mesh/inp_losses.h"

#include <fmt/format.h>

#include <algorithm>
#include <variant>

#include "formats/mesh/inp_materials.h"

namespace latsch::formats {
namespace {

using fe_tire::LossMaterials;
using fe_tire::PronyTerms;

/// Parts of a stress that relax.
enum class Relaxes { isochoric, whole };

PronyTerms terms_of(const InpDeck& deck, const InpMaterial& material, Relaxes part) {
  PronyTerms terms;
  if (material.relaxation.empty()) return terms;
  const Place& place = material.relaxation.front().place;
  if (material.instantaneous)
    throw InputError(place,
                     fmt::format("material {} states MODULI=INSTANTANEOUS beside *VISCOELASTIC; "
                                 "expected moduli of the relaxed material, MODULI=LONG TERM: those "
                                 "of the file times 1 - the sum of the shares g",
                                 material.name));
  for (const InpMaterial::Relaxation& row : material.relaxation) {
    const double g = deck.value(row.share), tau = deck.value(row.time);
    const double k = part == Relaxes::isochoric ? 0.0 : g;
    if (row.bulk != k)
      throw InputError(
          row.place,
          fmt::format("material {}: k is {} beside g = {}; expected {}",
                      material.name,
                      row.bulk,
                      g,
                      part == Relaxes::isochoric
                          ? "0, because the bulk modulus of rubber does not relax here"
                          : fmt::format("{}, because the whole stress of rebars and of materials "
                                        "of several directions relaxes",
                                        g)));
    terms.push_back({g, to_si(tau, InpQuantity::time, deck.units)});
  }
  const auto reject = [&](const std::string& why) {
    throw InputError(place, fmt::format("material {}: {}", material.name, why));
  };
  if (const Status good = fe_tire::check(terms); !good.ok()) reject(good.failure().reason);
  const auto relative = fe_tire::from_unrelaxed(terms);
  if (!relative) reject(relative.failure().reason);
  if (const Status good = fe_tire::check(*relative); !good.ok()) reject(good.failure().reason);
  return *relative;
}

/// Returns the index of an owner, which is added if it is new.
int owner(LossMaterials& losses, const std::string& name, bool is_cord) {
  const auto known = std::ranges::find(losses.owners, name, &LossMaterials::Owner::name);
  if (known != losses.owners.end()) return static_cast<int>(known - losses.owners.begin());
  losses.owners.push_back({name, is_cord});
  return static_cast<int>(losses.owners.size()) - 1;
}

fe_tire::RelaxingSolid relaxing_solid(const InpDeck& deck,
                                      const InpMaterial& material,
                                      const fe_tire::Solid& solid,
                                      int owner) {
  fe_tire::RelaxingSolid relaxing;
  relaxing.owner = owner;
  if (has_directions(material)) {
    const PronyTerms terms = terms_of(deck, material, Relaxes::whole);
    if (!terms.empty())
      relaxing.smeared.push_back({std::get<fe_tire::StVenantKirchhoff>(solid.law).D, terms, owner});
    return relaxing;
  }
  relaxing.terms = terms_of(deck, material, Relaxes::isochoric);
  if (const auto* linear = std::get_if<fe_tire::StVenantKirchhoff>(&solid.law))
    relaxing.shear = linear->D(3, 3);
  return relaxing;
}

}  // namespace

LossMaterials losses_of(const InpTire& tire, const InpDeck& deck) {
  LossMaterials losses;
  for (std::size_t i = 0; i < tire.solids.size(); ++i) {
    const InpMaterial& material = deck.materials.at(tire.solids[i].material);
    losses.solids.push_back(relaxing_solid(deck,
                                           material,
                                           tire.materials.solids[i],
                                           owner(losses, "material." + material.name, false)));
  }
  for (std::size_t i = 0; i < tire.layers.size(); ++i) {
    const int rebars = tire.layers[i].rebars;
    if (rebars < 0) {  // springs have no terms
      losses.layers.push_back({{}, owner(losses, fmt::format("layer.cords {}", i + 1), true)});
      continue;
    }
    const InpRebars& layer = deck.rebars[static_cast<std::size_t>(rebars)];
    losses.layers.push_back({terms_of(deck, deck.materials.at(layer.material), Relaxes::whole),
                             owner(losses, "layer." + layer.name, true)});
  }
  return losses;
}

}  // namespace latsch::formats
