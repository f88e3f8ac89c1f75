// SPDX-License-Identifier: Apache-2.0
#include "correlation/comparison/model_comparison_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "base/text.h"
#include "correlation/comparison/existing_file.h"
#include "correlation/laboratory/stated_share.h"
#include "experiment/language/kind_files.h"

namespace latsch::correlation {
namespace {

namespace fs = std::filesystem;

ComparedModel read_compared(const Node& table,
                            const fs::path& folder,
                            const experiment::Language& language) {
  ComparedModel model;
  model.name = table.name();
  model.title = table.text("title", table.name());
  const fs::path file = existing_file(table, "file", folder);
  model.kind =
      &experiment::kind_for_file(table.choice("kind", language.kind_names()), file, language.kinds);
  model.numbers = model.kind->read(file);
  model.kind->check(model.numbers);
  return model;
}

void read_reference(const Node& table,
                    const fs::path& folder,
                    const experiment::Language& language,
                    ModelComparisonFile& file) {
  file.reference = read_compared(table, folder, language);
  if (table.has("recordings")) file.recordings = folder / table.text("recordings");
  file.is_virtual = table.flag("virtual", false);
  if (file.is_virtual && file.recordings.empty())
    table.reject("virtual",
                 "is given without recordings: expected the folder into which latsch run writes "
                 "them");
  if (table.has("recorded")) file.recorded = table.texts("recorded");
  file.low_pass = table.quantity("low_pass", "Hz", Range::positive(), 0.0);
  file.seed = table.integer("seed", 0, 1'000'000'000, 1);
  if (const auto noise = table.find_table("noise")) {
    for (const std::string& channel : noise->keys()) {
      const char* unit = channel.starts_with("speed")  ? "m/s"
                         : channel.starts_with("line") ? "m"
                                                       : "N";
      file.noise[channel] = noise->quantity(channel, unit, Range::not_negative());
      // The noise of a recorded channel is that of the measurements that are written.
      const bool used = std::ranges::count(file.channels, channel) > 0 ||
                        std::ranges::count(file.recorded, channel) > 0;
      if (!file.recordings.empty() && !used)
        noise->reject(channel,
                      "is of a channel that is not compared, and recordings have their noise "
                      "already: expected one of the compared channels");
    }
  }
}

GridTest read_grid_test(const Node& table, const fs::path& folder) {
  GridTest test;
  test.name = table.name();
  const fs::path of_models = existing_file(table, "file", folder);
  const fs::path of_reference =
      table.has("reference") ? existing_file(table, "reference", folder) : of_models;
  test.model_test = Document::read(of_models);
  test.reference_test = Document::read(of_reference);
  test.folder = of_models.parent_path();
  test.reference_folder = of_reference.parent_path();
  test.recording = table.text("recording", "");
  if (table.has("mark")) {
    const auto paths = table.texts("mark");
    if (paths.size() != 2) table.reject("mark", "expected two paths, a speed and a length");
    test.mark = {paths[0], paths[1]};
  }
  if (const auto vary = table.find_table("vary")) {
    for (const std::string& path : vary->keys()) {
      VariedNumber one{path, test.model_test.unit(path), {}};
      one.values = vary->quantities(path, one.unit);
      if (one.values.empty()) vary->reject(path, "is empty");
      if (std::set<double>(one.values.begin(), one.values.end()).size() != one.values.size())
        vary->reject(path, "has a value twice, expected each once");
      test.varied.push_back(std::move(one));
    }
  }
  return test;
}

/// Adds all combinations of the varied parameters; the last parameter varies fastest.
void add_cases(const Node& table, ModelComparisonFile& file, std::size_t index) {
  const GridTest& test = file.tests[index];
  std::size_t count = 1;
  for (const VariedNumber& one : test.varied) count *= one.values.size();
  for (std::size_t number = 0; number < count; ++number) {
    ComparedCase one;
    one.test = index;
    one.name = test.name;
    one.model_test = test.model_test;
    one.reference_test = test.reference_test;
    std::size_t left = number, block = count;
    for (const VariedNumber& varied : test.varied) {
      block /= varied.values.size();
      const std::size_t level = left / block;
      left %= block;
      one.levels.push_back(level);
      one.name += fmt::format("-{}", level + 1);
      one.in_words += fmt::format("{}{} {:.4g} {}",
                                  one.in_words.empty() ? "" : ", ",
                                  varied.path,
                                  varied.values[level],
                                  varied.unit);
      one.model_test.set(varied.path, varied.values[level]);
      one.reference_test.set(varied.path, varied.values[level]);
    }
    one.recording = test.recording.empty() ? one.name : test.recording;
    if (!test.mark[0].empty()) {
      const double length = one.reference_test.get(test.mark[1]);
      if (length == 0.0) table.reject("mark", "divides by 0");
      one.mark = one.reference_test.get(test.mark[0]) / length;
    }
    file.cases.push_back(std::move(one));
  }
}

void read_bands(const Node& root, ModelComparisonFile& file) {
  for (const Node& table : root.named_tables("band")) {
    const auto edges = table.quantities("edges", "Hz", Range::positive());
    if (edges.size() != 2 || edges[0] >= edges[1])
      table.reject("edges", "expected two frequencies, the lower one first");
    file.bands.push_back({table.name(), {edges[0], edges[1]}});
  }
  if (file.bands.empty()) root.reject("band", "is missing, expected at least one [band.NAME]");
}

void read_factorial(const Node& root, ModelComparisonFile& file) {
  const auto table = root.find_table("factorial");
  if (!table) return;
  file.factors = table->texts("factors");
  if (file.factors.size() != 2) table->reject("factors", "expected two names");
  const auto names = table->texts("models");
  if (names.size() != 4)
    table->reject("models",
                  "expected four models: both factors low, the second high, the first high, both");
  for (std::size_t i = 0; i < 4; ++i) {
    const auto found =
        std::find_if(file.models.begin(), file.models.end(), [&](const ComparedModel& model) {
          return model.name == names[i];
        });
    if (found == file.models.end())
      table->reject("models", "has " + in_quotes(names[i]) + ", which is no [model.NAME]");
    file.factorial_models[i / 2][i % 2] = static_cast<std::size_t>(found - file.models.begin());
  }
}

void read_uncertainty(const Node& root, ModelComparisonFile& file) {
  for (const Node& table : root.named_tables("uncertainty")) {
    Uncertainty one{table.name(),
                    table.text("source", ""),
                    table.texts("paths"),
                    read_share(table, "spread", Range::positive())};
    for (const std::string& path : one.paths) {
      const auto has = [&](const ComparedModel& model) {
        const auto paths = model.numbers.paths();
        return std::find(paths.begin(), paths.end(), path) != paths.end();
      };
      if (std::none_of(file.models.begin(), file.models.end(), has))
        table.reject("paths", "has " + in_quotes(path) + ", which no model has");
    }
    file.uncertainties.push_back(std::move(one));
  }
  if (const auto table = root.find_table("bands")) {
    file.samples = static_cast<int>(table->integer("samples", 0, 10'000, 0));
    if (file.samples == 1)
      table->reject("samples", "is 1, which has no quantiles; expected 0 or at least 2");
    file.band_seed = table->integer("seed", 0, 1'000'000'000, 1);
    file.level = table->quantity("level", "1", Range::between(0.1, 0.999), 0.9);
  }
}

void read_fits(const Node& root,
               const fs::path& folder,
               const experiment::Language& language,
               ModelComparisonFile& file) {
  for (const Node& table : root.named_tables("fit")) {
    FitSource fit{table.name(), nullptr, {""}, table.place(), table.flag("bands", true)};
    fit.study =
        std::make_shared<const Study>(read_study(existing_file(table, "study", folder), language));
    if (table.has("at")) fit.at = table.texts("at");
    if (fit.at.empty()) table.reject("at", "is empty, expected at least one path");
    file.fits.push_back(std::move(fit));
  }
}

/// Reads the fits that a model names. Each fit must set parameters of the model, and no parameter
/// may be set twice.
void take_fits(const Node& table, const ModelComparisonFile& file, ComparedModel& model) {
  if (!table.has("fits")) return;
  std::set<std::string> moved;
  for (const std::string& name : table.texts("fits")) {
    const auto found = std::find_if(
        file.fits.begin(), file.fits.end(), [&](const FitSource& fit) { return fit.name == name; });
    if (found == file.fits.end())
      table.reject("fits", "has " + in_quotes(name) + ", which is no [fit.NAME]");
    check_fit(*found, model.numbers, model.title);
    for (const DesignVariable& variable : found->study->space.variables())
      for (const std::string& path : paths_of(*found, variable))
        if (!moved.insert(path).second)
          table.reject("fits", "move " + in_quotes(path) + " more than once");
    model.fits.push_back(static_cast<std::size_t>(found - file.fits.begin()));
  }
}

void read_pictures(const Node& root, ModelComparisonFile& file) {
  const auto table = root.find_table("pictures");
  if (!table) return;
  std::vector<std::string> models, cases;
  for (const ComparedModel& model : file.models) models.push_back(model.name);
  for (const ComparedCase& one : file.cases) cases.push_back(one.name);
  const auto place = [](const std::vector<std::string>& all, const std::string& name) {
    return static_cast<std::size_t>(std::find(all.begin(), all.end(), name) - all.begin());
  };
  const auto model = place(models, table->choice("model", models));
  file.pictures = {model, place(cases, table->choice("case", cases))};
}

/// Throws InputError if a test records no channel of a compared name. A test that takes conditions
/// from the reference is not known before the reference is.
void expect_channels(const Node& root,
                     const fs::path& folder,
                     const experiment::Language& language) {
  const std::vector<std::string> compared = root.texts("channels");
  for (const Node& table : root.named_tables("test")) {
    const GridTest grid = read_grid_test(table, folder);
    std::vector<std::string> names;
    try {
      const auto test = language.read_test(grid.model_test.root(), {grid.folder, nullptr});
      for (const experiment::ChannelInfo& channel : test->channels()) names.push_back(channel.name);
    } catch (const InputError&) {
      continue;
    }
    for (const std::string& channel : compared)
      if (std::ranges::count(names, channel) == 0)
        root.reject("channels",
                    "has " + in_quotes(channel) + ", which test " + grid.name + " does not record" +
                        did_you_mean(channel, names));
  }
}

ModelComparisonFile read_tables_of_models(const Node& root,
                                          const fs::path& path,
                                          const experiment::Language& language) {
  const fs::path folder = path.parent_path();
  ModelComparisonFile file;
  file.file = path;
  file.title = root.text("title", path.stem().string());
  file.channels = root.texts("channels");
  if (file.channels.empty()) root.reject("channels", "is empty, expected at least one channel");
  if (std::set<std::string>(file.channels.begin(), file.channels.end()).size() !=
      file.channels.size())
    root.reject("channels", "has a channel twice, expected each once");
  expect_channels(root, folder, language);
  if (root.has("told")) file.told = root.texts("told");
  if (std::set<std::string>(file.told.begin(), file.told.end()).size() != file.told.size())
    root.reject("told", "has a channel twice, expected each once");
  file.has_from = root.has("from");
  if (file.has_from) file.from = root.quantity("from", "s");
  file.segment = root.quantity("segment", "s", Range::positive());
  file.normalize = root.quantity("normalize", "Hz", Range::positive(), 0.0);
  read_bands(root, file);
  read_reference(root.table("reference"), folder, language, file);
  read_fits(root, folder, language, file);
  for (const Node& table : root.named_tables("model")) {
    file.models.push_back(read_compared(table, folder, language));
    take_fits(table, file, file.models.back());
  }
  for (const Node& table : root.named_tables("test")) {
    file.tests.push_back(read_grid_test(table, folder));
    add_cases(table, file, file.tests.size() - 1);
  }
  if (file.cases.empty())
    root.reject("test", "is missing, expected at least one [test.NAME] with its file");
  for (const ComparedCase& one : file.cases)
    if (file.find_case(one.recording) == file.cases.size())
      root.reject("test", "has no case " + in_quotes(one.recording) + " to take a recording of");
  read_factorial(root, file);
  read_uncertainty(root, file);
  read_pictures(root, file);
  root.close();
  return file;
}

}  // namespace

std::size_t ModelComparisonFile::find_case(const std::string& name) const {
  const auto found = std::find_if(
      cases.begin(), cases.end(), [&](const ComparedCase& one) { return one.name == name; });
  return static_cast<std::size_t>(found - cases.begin());
}

bool compares_models(const fs::path& file) {
  const auto keys = Document::read(file).root().keys();
  return std::find(keys.begin(), keys.end(), "model") != keys.end();
}

bool is_model_comparison(const fs::path& file) {
  if (file.extension() != ".toml") return false;
  const auto keys = Document::read(file).root().keys();
  return std::find(keys.begin(), keys.end(), "reference") != keys.end();
}

void expect_compared_channels(const fs::path& file, const experiment::Language& language) {
  const Document document = Document::read(file);
  if (document.root().has("channels"))
    expect_channels(document.root(), file.parent_path(), language);
}

std::vector<std::pair<std::string, fs::path>> studies_of_fits(const fs::path& file) {
  const Document document = Document::read(file);
  std::vector<std::pair<std::string, fs::path>> studies;
  if (!document.root().has("fit")) return studies;
  for (const Node& table : document.root().named_tables("fit"))
    studies.emplace_back(table.name(), existing_file(table, "study", file.parent_path()));
  return studies;
}

ModelComparisonFile read_model_comparison(const fs::path& path,
                                          const experiment::Language& language) {
  return read_tables_of_models(Document::read(path).root(), path, language);
}

std::map<std::string, DeclaredKey> keys_of_model_comparison(const fs::path& path,
                                                            const experiment::Language& language) {
  const Document document = Document::read(path);
  const DocumentRecord record(document.root());
  read_tables_of_models(record.node(), path, language);
  return record.keys();
}

}  // namespace latsch::correlation
