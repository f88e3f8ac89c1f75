// SPDX-License-Identifier: Apache-2.0
#include "correlation/study/refinement.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/text.h"
#include "correlation/study/program_specimens.h"
#include "correlation/study/simulator_settings.h"
#include "correlation/study/study_stages.h"

namespace latsch::correlation {
namespace {

std::vector<StudyTest>::iterator test_called(std::vector<StudyTest>& tests,
                                             const std::string& name) {
  return std::find_if(
      tests.begin(), tests.end(), [&](const StudyTest& test) { return test.name == name; });
}

void check_names(const Node& table, const Study& study, const std::vector<StudyTest>& finer) {
  std::vector<std::string> known;
  for (const StudyTest& test : study.tests)
    if (!test.is_own) known.push_back(test.name);
  for (const StudyTest& test : finer) {
    if (std::find(known.begin(), known.end(), test.name) != known.end()) continue;
    table.reject("test",
                 "has " + in_quotes(test.name) + did_you_mean(test.name, known) +
                     (known.empty() ? ", but this study has no [test.NAME]"
                                    : ", expected some of " + list_of(known)));
  }
}

}  // namespace

std::optional<Refinement> read_refinement(const Node& root,
                                          const Document& text,
                                          const Study& study,
                                          const experiment::Language& language,
                                          const Laboratory& laboratory) {
  const auto table = root.find_table("refined");
  if (!table) return std::nullopt;
  Refinement refinement;
  const experiment::SpecimenKind* kind = study.specimens->kind();
  if (!kind) {
    const Simulator simulator = read_simulator(table->table("simulator"), study.file, study.space);
    refinement.specimens = specimens_of(simulator);
    refinement.tests.push_back(test_of(simulator));
    return refinement;
  }
  if (table->has("simulator"))
    table->reject("simulator", "is an outside program, but this study has a model");
  refinement.numbers = read_changed_numbers(*table, text, study);
  refinement.tests = read_tests(*table, study.file.parent_path(), *kind, language, laboratory);
  check_names(*table, study, refinement.tests);
  if (refinement.numbers.empty() && refinement.tests.empty())
    root.reject("refined",
                "changes nothing, expected numbers such as model.mesh.sectors = 80, or a "
                "[refined.test.NAME]");
  return refinement;
}

Study refined(const Study& study) {
  const Refinement& refinement = *study.refinement;
  Study finer = study;
  for (const auto& [path, value] : refinement.numbers) finer.model.set(path, value);
  for (const StudyTest& test : refinement.tests) *test_called(finer.tests, test.name) = test;
  if (refinement.specimens) finer.specimens = refinement.specimens;
  finer.asks_slopes = false;
  finer.run.journal.replace_extension(".refined.latsch");
  return finer;
}

std::string in_words(const Refinement& refinement) {
  if (refinement.specimens) return "another outside program";
  std::string text, tests;
  for (const auto& [path, value] : refinement.numbers)
    text += fmt::format("{}{} = {:g}", text.empty() ? "" : ", ", path, value);
  for (const StudyTest& test : refinement.tests) tests += (tests.empty() ? "" : ", ") + test.name;
  if (tests.empty()) return text;
  return text + (text.empty() ? "" : "; ") + "tests " + tests;
}

}  // namespace latsch::correlation
