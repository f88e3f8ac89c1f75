// SPDX-License-Identifier: Apache-2.0
#include "correlation/validation/suite.h"

#include "correlation/laboratory/stated_share.h"
#include "correlation/study/ledgers/study_ledgers.h"

namespace latsch::correlation {
namespace {

void read_number(const Node& table, const std::vector<StudyTest>& tests, Check& check) {
  for (const char* key : {"mean_error", "largest_error"}) {
    if (table.has(key))
      table.reject(key,
                   "belongs to a comparison with a measurement: expected kind (\"values\", "
                   "\"curve\", ...) beside it; a number of a channel has lower and upper");
  }
  if (table.has("equal"))
    table.reject("equal", "leaves no room for any difference, expected lower and upper");
  check.number = read_channel_range(table, known_channels(tests));
}

void read_experiment_of(const Node& table,
                        const ExperimentContext& context,
                        std::vector<StudyTest>& tests,
                        Check& check) {
  for (const char* key : {"weight", "use", "exponent", "noise", "loss"}) {
    if (table.has(key))
      table.reject(key,
                   "weights a fit: it belongs in a study; a check has mean_error, "
                   "largest_error");
  }
  if (table.has("mean_error"))
    check.mean_error = read_share(table, "mean_error", Range::not_negative());
  if (table.has("largest_error"))
    check.largest_error = read_share(table, "largest_error", Range::not_negative());
  if (!check.mean_error && !check.largest_error)
    table.reject("largest_error",
                 "is missing, expected a limit such as largest_error = \"5 %\", or mean_error");
  check.experiment = read_experiment(table, context, tests);
}

Suite read(const Node& root,
           const std::filesystem::path& file,
           const experiment::SpecimenKind& kind,
           const experiment::Language& language) {
  const auto checks = root.named_tables("check");
  if (checks.empty())
    root.reject("check",
                "is missing, expected a suite, which has [check.NAME], each with what is compared, "
                "its limits and their source");
  const auto folder = file.parent_path();
  const Laboratory laboratory = read_laboratory(root, folder);
  Suite suite{file,
              root.text("title", file.stem().string()),
              read_tests(root, folder, kind, language, laboratory),
              {}};
  const ExperimentContext context{folder, Measurements::required, language, laboratory, &kind};
  for (const Node& table : checks) {
    Check check;
    check.name = table.name();
    check.source = table.text("source");
    if (check.source.empty()) table.reject("source", "is empty, expected the source of the limit");
    if (table.has("kind")) {
      read_experiment_of(table, context, suite.tests, check);
    } else {
      read_number(table, suite.tests, check);
    }
    suite.checks.push_back(std::move(check));
  }
  root.close();
  for (const auto& measurement : laboratory) refuse_doubtful(measurement->ledgers());
  return suite;
}

}  // namespace

Suite read_suite(const std::filesystem::path& file,
                 const experiment::SpecimenKind& kind,
                 const experiment::Language& language) {
  return read(Document::read(file).root(), file, kind, language);
}

std::map<std::string, DeclaredKey> keys_of_suite(const std::filesystem::path& file,
                                                 const experiment::SpecimenKind& kind,
                                                 const experiment::Language& language) {
  const Document document = Document::read(file);
  const DocumentRecord record(document.root());
  read(record.node(), file, kind, language);
  return record.keys();
}

}  // namespace latsch::correlation
