// SPDX-License-Identifier: Apache-2.0
#include "formats/deck/inp_references.h"

#include <fmt/format.h>

#include <set>

namespace latsch::formats {
namespace {

template <class Value>
void find(const std::map<std::string, Value>& map,
          const std::string& name,
          const char* kind,
          const Place& place) {
  if (!map.count(name))
    throw InputError(place,
                     fmt::format("{} \"{}\" is not defined above", kind, name.substr(0, 60)));
}

void check_rebars(const InpDeck& deck) {
  for (const InpRebars& rebars : deck.rebars) {
    find(deck.element_sets, rebars.elset, "ELSET", rebars.place);
    find(deck.materials, rebars.material, "MATERIAL", rebars.place);
    if (!rebars.orientation.empty())
      find(deck.orientations, rebars.orientation, "ORIENTATION", rebars.place);
  }
  for (const InpEmbedding& embedding : deck.embeddings) {
    if (!embedding.host.empty()) find(deck.element_sets, embedding.host, "ELSET", embedding.place);
    for (const std::string& elset : embedding.elsets)
      find(deck.element_sets, elset, "ELSET", embedding.place);
  }
}

/// Names that differ only in characters that a path cannot contain would have the same path, so
/// they are refused.
void check_paths(const InpDeck& deck) {
  std::set<std::string> paths;
  for (const InpNumber& number : deck.numbers)
    if (!paths.insert(number.path).second)
      throw InputError({deck.file, number.where.empty() ? 0 : number.where.front().line},
                       fmt::format("{} is given twice", number.path));
}

template <class Value>
void check_members(const InpDeck& deck,
                   const std::string& name,
                   const std::vector<int>& set,
                   const std::map<int, Value>& defined,
                   const char* kind) {
  for (int number : set)
    if (!defined.count(number))
      throw InputError(
          {deck.file, 0},
          fmt::format("set \"{}\" holds {} {}, which is not defined", name, kind, number));
}

}  // namespace

void check_references(const InpDeck& deck) {
  for (const auto& [number, element] : deck.elements)
    for (int node : element.node)
      if (!deck.nodes.count(node))
        throw InputError(
            element.place,
            fmt::format("element {} uses node {}, which is not defined", number, node));
  for (const auto& [name, set] : deck.node_sets) check_members(deck, name, set, deck.nodes, "node");
  for (const auto& [name, set] : deck.element_sets)
    for (int number : set)
      if (!deck.elements.count(number) && !deck.surface_elements.count(number))
        throw InputError(
            {deck.file, 0},
            fmt::format("set \"{}\" holds element {}, which is not defined", name, number));
  for (const auto& [number, element] : deck.surface_elements)
    for (int node : element.node)
      if (!deck.nodes.count(node))
        throw InputError(
            element.place,
            fmt::format("element {} uses node {}, which is not defined", number, node));
  check_rebars(deck);
  for (const InpSection& section : deck.sections) {
    find(deck.element_sets, section.elset, "ELSET", section.place);
    find(deck.materials, section.material, "MATERIAL", section.place);
    if (!section.orientation.empty())
      find(deck.orientations, section.orientation, "ORIENTATION", section.place);
  }
  for (const InpContact& contact : deck.contacts) {
    find(deck.interactions, contact.interaction, "SURFACE INTERACTION", contact.place);
    find(deck.surfaces, contact.slave, "SURFACE", contact.place);
    find(deck.surfaces, contact.master, "SURFACE", contact.place);
  }
  check_paths(deck);
}

}  // namespace latsch::formats
