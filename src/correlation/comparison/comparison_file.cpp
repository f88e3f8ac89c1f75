// SPDX-License-Identifier: Apache-2.0
#include "correlation/comparison/comparison_file.h"

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "correlation/comparison/existing_file.h"
#include "correlation/study/specimens.h"
#include "experiment/language/kind_files.h"
#include "measurement/band_level.h"

namespace latsch::correlation {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> kForces = {"Fx", "Fy", "Fz", "Mx", "My", "Mz"};

ComparedTire read_tire(const Node& table,
                       const fs::path& folder,
                       const experiment::Language& language) {
  const fs::path file = existing_file(table, "file", folder);
  const auto* kind =
      &experiment::kind_for_file(table.choice("kind", language.kind_names()), file, language.kinds);
  ComparedTire tire{table.name(), {}, kind, file, kind->read(file), {}, {}};
  kind->check(tire.numbers);  // throws for numbers that make no tire, before the first test runs
  tire.title = table.text("title", table.name());
  tire.built_from = table.text("built_from", "");
  tire.parameters = table.text("parameters", "");
  return tire;
}

ComparedSpecimen read_specimen(const Node& table,
                               const fs::path& folder,
                               const experiment::Language& language) {
  ComparedSpecimen specimen{read_tire(table, folder, language), 0.0, {}, 1};
  specimen.step = table.quantity("step", "s", Range::positive(), 0.0);
  specimen.seed = table.integer("seed", 0, 1'000'000'000, 1);
  if (const auto noise = table.find_table("noise")) {
    for (const std::string& channel : kForces) {
      if (noise->has(channel))
        specimen.noise[channel] = noise->quantity(channel, unit_of(channel), Range::not_negative());
    }
  }
  return specimen;
}

/// Returns the recording that the key `measurement` names: a [measurement.NAME], or else a file.
std::shared_ptr<const Measurement> read_recording(const Node& table,
                                                  const fs::path& folder,
                                                  const Laboratory& laboratory) {
  if (auto stated = find(laboratory, table.text("measurement"))) return stated;
  return std::make_shared<Measurement>(
      read_measurement(existing_file(table, "measurement", folder)));
}

ComparisonTest read_test(const Node& table,
                         const fs::path& folder,
                         const experiment::Language& language,
                         const std::vector<const experiment::SpecimenKind*>& kinds,
                         const Laboratory& laboratory,
                         bool specimen) {
  const fs::path file = existing_file(table, "file", folder);
  const auto test = language.read_test(file);
  const auto* drum = test->settings_as<experiment::DrumTest>();
  if (!drum) table.reject("file", "is no drum test, expected kind = \"drum_cleat\" in it");
  for (const experiment::SpecimenKind* kind : kinds)
    if (const auto reason = reason_against(*kind, *test, language)) table.reject("file", *reason);
  if (drum->frames.size() > 1)
    table.reject("file", "is of a test that records several frames, expected one of them in it");
  ComparisonTest one{table.name(), test->in_words(), *drum, {}, table.flag("fitted", false)};
  if (specimen == table.has("measurement"))
    table.reject("measurement",
                 specimen ? "is given beside [specimen], expected one of them"
                          : "is missing: there is no [specimen] in its place");
  if (!specimen) one.measurement = read_recording(table, folder, laboratory);
  return one;
}

ComparisonFile read_tables(const Node& root,
                           const fs::path& file,
                           const experiment::Language& language) {
  const fs::path folder = file.parent_path();
  ComparisonFile comparison;
  comparison.file = file;
  comparison.title = root.text("title", file.stem().string());
  comparison.channels =
      root.has("channels") ? root.texts("channels") : std::vector<std::string>{"Fx", "Fz"};
  for (const std::string& channel : comparison.channels) {
    if (std::find(kForces.begin(), kForces.end(), channel) == kForces.end())
      root.reject("channels", "has " + in_quotes(channel) + ", expected " + list_of(kForces));
    const auto& all = comparison.channels;
    if (std::count(all.begin(), all.end(), channel) > 1)
      root.reject("channels", "has " + in_quotes(channel) + " twice, expected each once");
  }
  if (comparison.channels.empty())
    root.reject("channels", "is empty, expected at least one of " + list_of(kForces));
  comparison.band = {8.0, 200.0};
  if (root.has("band")) {
    const auto ends = root.quantities("band", "Hz", Range::positive());
    if (ends.size() != 2 || ends[0] >= ends[1])
      root.reject("band", "expected two frequencies, the lower one first");
    comparison.band = {ends[0], ends[1]};
    if (third_octave_bands(comparison.band).empty())
      root.reject(
          "band",
          "has no center of a third-octave band between its ends, expected a wider one such "
          "as [\"8 Hz\", \"200 Hz\"]");
  }
  comparison.agreement = root.quantity("agreement", "1", Range::positive(), 3.0);
  if (const auto table = root.find_table("specimen"))
    comparison.specimen = read_specimen(*table, folder, language);
  for (const Node& table : root.named_tables("tire"))
    comparison.tires.push_back(read_tire(table, folder, language));
  if (comparison.tires.empty())
    root.reject("tire", "is missing, expected at least one [tire.NAME] with kind and file");
  std::vector<const experiment::SpecimenKind*> kinds;
  for (const ComparedTire& tire : comparison.tires) kinds.push_back(tire.kind);
  if (comparison.specimen) kinds.push_back(comparison.specimen->tire.kind);
  const Laboratory laboratory =
      root.has("measurement") ? read_laboratory(root, folder) : Laboratory();
  for (const Node& table : root.named_tables("test"))
    comparison.tests.push_back(
        read_test(table, folder, language, kinds, laboratory, comparison.specimen.has_value()));
  for (const ComparisonTest& test : comparison.tests) {
    if (!test.measurement) continue;
    test.measurement->note_use("time", "test " + test.name);
    for (const std::string& channel : comparison.channels)
      test.measurement->note_use(channel, "test " + test.name);
  }
  if (comparison.tests.empty())
    root.reject("test", "is missing, expected at least one [test.NAME] with its file");
  for (const ComparisonTest& test : comparison.tests) {
    const double step = comparison.specimen ? comparison.specimen->step : 0.0;
    const double ratio = step > 0.0 ? test.drum.sample_step / step : 1.0;
    if (ratio < 0.5 || std::abs(ratio - std::round(ratio)) > 1e-6)
      root.table("specimen").reject("step", "does not divide the sample_step of test " + test.name);
  }
  root.close();
  return comparison;
}

}  // namespace

const char* unit_of(const std::string& channel) { return channel[0] == 'F' ? "N" : "N m"; }

ComparisonFile read_comparison_file(const fs::path& file, const experiment::Language& language) {
  return read_tables(Document::read(file).root(), file, language);
}

std::map<std::string, DeclaredKey> keys_of_comparison(const fs::path& file,
                                                      const experiment::Language& language) {
  const Document document = Document::read(file);
  const DocumentRecord record(document.root());
  read_tables(record.node(), file, language);
  return record.keys();
}

}  // namespace latsch::correlation
