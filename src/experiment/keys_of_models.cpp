// SPDX-License-Identifier: Apache-2.0
#include "experiment/keys_of_models.h"

#include <utility>

#include "base/text.h"
#include "experiment/kinds/composed_suspension.h"
#include "experiment/kinds/specimen_kinds.h"
#include "experiment/language.h"
#include "models/car/car_reader.h"
#include "models/fe_tire/description/tire_description.h"
#include "models/ring_tire/description/ring_reader.h"
#include "models/suspension/suspension_reader.h"

namespace latsch::experiment {
namespace {

using Keys = std::map<std::string, DeclaredKey>;

/// Reads what the composition of a suspension takes from its file: names of other files.
Keys names_in_suspension(const Document& written) {
  const DocumentRecord record(written.root());
  const Node& root = record.node();
  if (root.has("hardpoints")) root.text("hardpoints");
  if (root.has("hardpoints_of")) root.text("hardpoints_of");
  if (root.has("bushing"))
    for (const Node& bushing : root.named_tables("bushing"))
      if (bushing.has("file")) bushing.text("file");
  return record.keys();
}

Keys keys_of_suspension(const std::filesystem::path& file) {
  const Document written = Document::read(file);
  const Document composed = composed_suspension(written, file.parent_path()).document;
  const DocumentRecord record(composed.root());
  suspension::read_corner(record.node());
  Keys keys = record.keys();
  for (auto& [path, key] : names_in_suspension(written)) {
    // Keys that come from the other files are not written in this one.
    if (path == "hardpoints" && key.is_there)
      std::erase_if(keys, [](const auto& one) { return one.first.starts_with("hardpoint."); });
    const bool is_file = path.ends_with(".file") && key.is_there;
    if (is_file) {
      const std::string table = path.substr(0, path.size() - std::string(".file").size());
      std::erase_if(keys, [&](const auto& one) { return one.first.starts_with(table + "."); });
    }
    keys.emplace(path, std::move(key));
  }
  return keys;
}

/// Reads what a car's file says of its suspensions and tires: a file or a table of each.
Keys parts_of_car(const Document& written) {
  const DocumentRecord record(written.root());
  const Node& root = record.node();
  const auto part = [&](const std::string& key) {
    if (!root.has(key)) return;
    try {
      root.text(key);
    } catch (const InputError&) {  // a table with the content of the file
      root.table(key);
    }
  };
  for (const std::string axle : {"front", "rear"}) {
    part(axle + "_suspension");
    for (const char* of : {"_tire", "_tire_right"}) part(axle + of);
    root.choice(axle + "_tire_kind", {"magic_formula", "rigid_ring"}, "magic_formula");
  }
  return record.keys();
}

Keys keys_of_car(const std::filesystem::path& file) {
  const Document whole = car_kind().read(file);
  const DocumentRecord record(whole.root());
  car::read_car(record.node());
  Keys keys = record.keys();
  std::erase_if(keys, [](const auto& one) {
    return one.first.starts_with("front_suspension") || one.first.starts_with("rear_suspension");
  });
  for (auto& [path, key] : parts_of_car(Document::read(file)))
    keys.insert_or_assign(path, std::move(key));
  return keys;
}

}  // namespace

Keys keys_of_model(const std::filesystem::path& file) {
  const SpecimenKind* const kind = &language().kind_of_file(file);
  if (kind == &suspension_kind()) return keys_of_suspension(file);
  if (kind == &car_kind()) return keys_of_car(file);
  const Document document = Document::read(file);
  const DocumentRecord record(document.root());
  if (kind == &fe_tire_kind()) {
    fe_tire::read_tire(record.node());
  } else if (kind == &ring_tire_kind()) {
    ring_tire::read_ring_tire(record.node());
  } else {
    throw InputError(
        {file.string(), 0},
        "is a " + kind->in_words() +
            ", expected a finite-element tire, a flexible ring, a suspension or a car");
  }
  return record.keys();
}

}  // namespace latsch::experiment
