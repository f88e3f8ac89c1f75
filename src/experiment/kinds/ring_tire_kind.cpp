// SPDX-License-Identifier: Apache-2.0
// The flexible ring as a kind of tire.
#include "experiment/kinds/tire_kind.h"
#include "models/ring_tire/description/ring_reader.h"
#include "models/ring_tire/ring/ring_tire.h"

namespace latsch::experiment {
namespace {

Document read(const std::filesystem::path& file) {
  Document document = Document::read(file);
  ring_tire::read_ring_tire(document.root());  // what is wrong is said of the file as it stands
  return document;
}

std::unique_ptr<Tire> build_ring_tire(const Document& numbers) {
  return std::make_unique<ring_tire::RingTire>(ring_tire::read_ring_tire(numbers.root()));
}

Result<Channels> modes(const Document& numbers, const VibrationTest& test) {
  ring_tire::RingTire tire(ring_tire::read_ring_tire(numbers.root()));
  return run(tire, test);
}

std::string text(const Document& numbers) { return numbers.text(); }

}  // namespace

extern const TireKind kRingTireKind;
const TireKind kRingTireKind = {"ring_tire",
                                "flexible ring",
                                "a TOML file with kind = \"ring_tire\"",
                                read,
                                build_ring_tire,
                                text,
                                nullptr,
                                modes};

}  // namespace latsch::experiment
