// SPDX-License-Identifier: Apache-2.0
#include "correlation/study/specimens.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <sstream>

#include "base/file.h"
#include "base/text.h"
#include "correlation/study/study.h"
#include "correlation/study/variables.h"

namespace latsch::correlation {
namespace {

namespace fs = std::filesystem;
using experiment::Language;
using experiment::SpecimenKind;

fs::path existing_file(const Node& table, const char* key, const fs::path& folder) {
  const fs::path file = (folder / table.text(key)).lexically_normal();
  if (!fs::exists(file))
    table.reject(key, "is " + in_quotes(file.string()) + ", which does not exist");
  return file;
}

class ModelSpecimens : public Specimens {
 public:
  ModelSpecimens(const SpecimenKind& kind, bool is_stated) : kind_(kind), is_stated_(is_stated) {}

  std::unique_ptr<experiment::Specimen> at(
      const Study& study,
      const DesignPoint& point,
      std::unique_ptr<experiment::Specimen> reuse) const override {
    return kind_.build(correlation::at(study.model, study.space, point), std::move(reuse));
  }
  void check(const Study& study) const override { kind_.check(study.model); }
  const SpecimenKind* kind() const override { return &kind_; }

  StudyIdentity identity(const Study& study) const override {
    std::string varied, cases;
    for (const DesignVariable& variable : study.space.variables()) {
      varied += fmt::format("{}: {}\n", variable.name, fmt::join(variable.paths, ", "));
      for (const Follower& follower : variable.followers)
        varied += fmt::format("  {} times: {}\n", follower.factor, fmt::join(follower.paths, ", "));
    }
    if (is_stated_) varied += "kind: " + kind_.name() + "\n";  // the version says it too
    const auto asked = tests_asked_for(study);
    for (const StudyTest& test : study.tests) {
      if (std::find(asked.begin(), asked.end(), test.name) != asked.end())
        cases +=
            fmt::format("{}: {}\n", test.name, test.is_own ? test.text : without_notes(test.text));
    }
    return {{"model", without_notes(study.model.text())},
            {"variables", varied},
            {"experiments", cases},
            {kModelVersionPart, fmt::format("{} {}\n", kind_.name(), kind_.version())}};
  }

  std::string describe(const Study& study) const override {
    const Document initial = correlation::at(study.model, study.space, study.space.initial());
    return "Model " + study.model_file.string() + ": " + kind_.describe(initial);
  }

 private:
  const SpecimenKind& kind_;
  bool is_stated_;  // by the study; else the file says it
};

bool has_table(const Node& root, const char* key) {
  try {
    return root.find_table(key).has_value();
  } catch (const InputError&) {
    return false;  // a text
  }
}

}  // namespace

std::shared_ptr<const Specimens> specimens_of(const SpecimenKind& kind, bool is_stated) {
  return std::make_shared<ModelSpecimens>(kind, is_stated);
}

StudyModel read_model(const Node& study, const fs::path& folder, const Language& language) {
  StudyModel model;
  const SpecimenKind* kind = nullptr;
  const bool is_stated = has_table(study, "model");
  if (is_stated) {
    const Node table = study.table("model");
    kind = language.find_kind(table.choice("kind", language.kind_names()));
    model.file = existing_file(table, "file", folder);
  } else {
    model.file = existing_file(study, "model", folder);
    kind = &language.kind_of_file(model.file);
  }
  model.numbers = kind->read(model.file);
  model.specimens = specimens_of(*kind, is_stated);
  return model;
}

std::optional<std::string> reason_against(const SpecimenKind& kind,
                                          const experiment::Test& test,
                                          const Language& language) {
  if (experiment::can(kind, test)) return std::nullopt;
  return fmt::format("is a test ({}) for a model that {}, which a {} does not; one that does: {}",
                     test.in_words(),
                     fmt::join(test.needs(), " or "),
                     kind.in_words(),
                     list_of(language.kinds_for(test.needs())));
}

std::vector<StudyTest> read_tests(const Node& study,
                                  const fs::path& folder,
                                  const SpecimenKind& kind,
                                  const Language& language) {
  std::vector<StudyTest> tests;
  for (const Node& table : study.named_tables("test")) {
    const fs::path file = existing_file(table, "file", folder);
    StudyTest test{table.name(), language.read_test(file), read_text_file(file)};
    for (const fs::path& named : test.test->files()) test.text += read_text_file(named);
    if (const auto reason = reason_against(kind, *test.test, language))
      table.reject("file", *reason);
    tests.push_back(std::move(test));
  }
  return tests;
}

std::vector<KnownChannel> known_channels(const std::vector<StudyTest>& tests) {
  std::vector<KnownChannel> channels;
  for (const StudyTest& test : tests) {
    for (const auto& channel : test.test->channels()) {
      const std::string name = test.name.empty() ? channel.name : test.name + "/" + channel.name;
      channels.push_back({name, channel.unit, channel.frame});
    }
  }
  return channels;
}

std::string test_of(const std::string& channel) { return channel.substr(0, channel.find('/')); }

std::string without_notes(const std::string& text) {
  std::istringstream lines(text);
  std::string kept;
  for (std::string line; std::getline(lines, line);) {
    const auto first = line.find_first_not_of(" \t\r");
    if (first != std::string::npos && line[first] != '#') kept += line + '\n';
  }
  return kept;
}

}  // namespace latsch::correlation
