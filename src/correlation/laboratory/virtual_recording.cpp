// SPDX-License-Identifier: Apache-2.0
#include "correlation/laboratory/virtual_recording.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string_view>
#include <utility>

#include "base/document_record.h"
#include "base/file.h"
#include "base/text.h"
#include "experiment/language/known_limits.h"
#include "formats/tables/csv_table.h"

namespace latsch::correlation {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kRecipeMark = "; recipe ";
constexpr std::string_view kValuesMark = "; values ";

/// Reads a test from its keys, which stand in the study or in a file.
experiment::ReadTest read_virtual_test(const Node& keys,
                                       const fs::path& folder,
                                       const experiment::Language& language) {
  const DocumentRecord record(keys);
  return language.read_identified_test(record.node(), {folder, nullptr});
}

/// Reads the key `test` of a table `virtual`: the name of a [test.NAME] of the study, or a file.
experiment::ReadTest read_named_test(const Node& study,
                                     const Node& source,
                                     const fs::path& folder,
                                     const experiment::Language& language) {
  const std::string name = source.text("test");
  std::vector<std::string> names;
  if (study.has("test"))
    for (const Node& table : study.named_tables("test")) {
      names.push_back(table.name());
      if (table.name() != name) continue;
      if (table.has("kind")) return read_virtual_test(table, folder, language);
      const fs::path file = folder / table.text("file");
      if (!fs::exists(file))
        table.reject("file", "is " + in_quotes(file.string()) + ", which does not exist");
      return read_virtual_test(Document::read(file).root(), file.parent_path(), language);
    }
  const fs::path file = folder / name;
  if (!fs::is_regular_file(file))
    source.reject("test",
                  fmt::format("is {}, which is neither a [test.NAME] of this study nor a file{}",
                              in_quotes(name),
                              did_you_mean(name, names)));
  return read_virtual_test(Document::read(file).root(), file.parent_path(), language);
}

VirtualRecording read_virtual(const Node& study,
                              const Node& measurement,
                              const Node& source,
                              const fs::path& folder,
                              const experiment::Language& language) {
  VirtualRecording one;
  one.name = "measurement." + measurement.name();
  if (!measurement.has("file"))
    measurement.reject("file", "is missing: a virtual recording is written to one file");
  one.file = (folder / measurement.text("file")).lexically_normal();
  if (one.file.extension() != ".csv")
    measurement.reject("file",
                       "is " + in_quotes(measurement.text("file")) +
                           ", expected a .csv, which a virtual recording is written as");
  one.model_file = (folder / source.text("model")).lexically_normal();
  if (!fs::exists(one.model_file))
    source.reject("model", "is " + in_quotes(one.model_file.string()) + ", which does not exist");
  one.kind = &language.kind_of_file(one.model_file);
  one.numbers = one.kind->read(one.model_file);
  one.test_name = source.text("test");
  experiment::ReadTest read = read_named_test(study, source, folder, language);
  one.test = std::move(read.test);
  if (!experiment::can(*one.kind, *one.test))
    source.reject(
        "test",
        fmt::format("is {}, which {} ({}) cannot undergo; expected a test of such models: "
                    "latsch test --list",
                    in_quotes(one.test_name),
                    one.model_file.filename().string(),
                    one.kind->in_words()));
  one.recipe = fingerprint(one.kind->name() + "\n" + canonical_text(one.numbers) + read.identity);
  return one;
}

}  // namespace

std::string VirtualRecording::in_words() const {
  return fmt::format("test {} of {}", test_name, model_file.filename().string());
}

std::vector<VirtualRecording> virtual_recordings(const fs::path& study,
                                                 const experiment::Language& language) {
  const Document document = Document::read(study);
  const Node root = document.root();
  std::vector<VirtualRecording> recordings;
  if (!root.has("measurement")) return recordings;
  for (const Node& table : root.named_tables("measurement"))
    if (const auto source = table.find_table("virtual"))
      recordings.push_back(read_virtual(root, table, *source, study.parent_path(), language));
  return recordings;
}

std::string recording_text(const std::string& in_words,
                           const std::string& recipe,
                           const std::string& table) {
  return fmt::format("# Recorded by latsch run: {}{}{}{}{}\n{}",
                     in_words,
                     kRecipeMark,
                     recipe,
                     kValuesMark,
                     fingerprint(table),
                     table);
}

std::string why_to_record(const fs::path& file, const std::string& recipe) {
  if (!fs::exists(file)) return "it has not been recorded";
  std::ifstream in(file);  // not read_text_file(), after which the file could not be replaced
  std::string text(std::istreambuf_iterator<char>(in), {});
  std::erase(text, '\r');  // some programs add it to every line
  const std::size_t end = std::min(text.find('\n'), text.size());
  const std::string first = text.substr(0, end);
  const std::size_t recipe_mark = first.rfind(kRecipeMark), values_mark = first.rfind(kValuesMark);
  if (!first.starts_with("#") || recipe_mark == first.npos || values_mark == first.npos ||
      values_mark < recipe_mark)
    return "it does not say of which model and test it is";
  const std::size_t recipe_begin = recipe_mark + kRecipeMark.size();
  if (first.substr(recipe_begin, values_mark - recipe_begin) != recipe)
    return "the model or the test has changed since it was recorded";
  const std::string table = text.substr(std::min(end + 1, text.size()));
  return first.substr(values_mark + kValuesMark.size()) == fingerprint(table) ? "" : kEdited;
}

void refuse_outdated_recordings(const fs::path& study, const experiment::Language& language) {
  for (const VirtualRecording& one : virtual_recordings(study, language))
    if (const std::string why = why_to_record(one.file, one.recipe); !why.empty())
      throw InputError({study.string(), 0},
                       fmt::format("{} is {}, the {}, and {}. Expected: latsch run {}, which "
                                   "records it; or {} without the key virtual, if the file is a "
                                   "measurement of its own",
                                   one.name,
                                   in_quotes(one.file.string()),
                                   one.in_words(),
                                   why,
                                   study.string(),
                                   one.name));
}

Result<Channels> recorded_channels(const experiment::SpecimenKind& kind,
                                   const Document& numbers,
                                   const experiment::Test& test,
                                   std::vector<std::string>* limits) {
  const auto specimen = kind.build(numbers);
  auto channels = test.run(*specimen);
  if (!channels || !limits) return channels;
  if (const auto* tells = dynamic_cast<const experiment::TellsLimits*>(&test))
    *limits = tells->limits(*specimen);
  for (std::string& limit : experiment::limits_met(*specimen)) limits->push_back(std::move(limit));
  return channels;
}

Result<std::vector<std::string>> record(const VirtualRecording& recording) {
  std::vector<std::string> limits;
  const auto channels =
      recorded_channels(*recording.kind, recording.numbers, *recording.test, &limits);
  if (!channels) return channels.failure();
  fs::create_directories(recording.file.parent_path().empty() ? fs::path(".")
                                                              : recording.file.parent_path());
  write_text_file(
      recording.file,
      recording_text(recording.in_words(), recording.recipe, formats::csv_text(*channels)));
  return limits;
}

}  // namespace latsch::correlation
