// SPDX-License-Identifier: Apache-2.0
#include "correlation/study/specimens.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <sstream>

#include "base/document_record.h"
#include "base/text.h"
#include "correlation/observable/compared_frame.h"
#include "correlation/study/study.h"
#include "correlation/study/variables.h"
#include "experiment/language/kind_files.h"

namespace latsch::correlation {
namespace {

namespace fs = std::filesystem;
using experiment::Language;
using experiment::SpecimenKind;

fs::path file_beside_study(const Node& table, const char* key, const fs::path& folder) {
  const fs::path file = (folder / table.text(key)).lexically_normal();
  if (!fs::exists(file))
    table.reject(key,
                 "is " + in_quotes(table.text(key)) + ", which does not exist" +
                     (folder.empty() || fs::path(table.text(key)).is_absolute()
                          ? ""
                          : " in the folder of the study"));
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
    std::string varied;
    for (const DesignVariable& variable : study.space.variables()) {
      varied += fmt::format("{}: {}\n", variable.name, fmt::join(variable.paths, ", "));
      for (const Follower& follower : variable.followers)
        varied += fmt::format("  {} times: {}\n", follower.factor, fmt::join(follower.paths, ", "));
    }
    // the version also contains the kind of the model
    if (is_stated_) varied += "kind: " + kind_.name() + "\n";
    return {{kModelPart, canonical_text(study.model)},
            {"variables", varied},
            {kTestsPart, identity_of_tests(study.tests, tests_asked_for(study))},
            {kModelVersionPart, fmt::format("{} {}\n", kind_.name(), kind_.version())}};
  }

  std::string describe(const Study& study) const override {
    const Document initial = correlation::at(study.model, study.space, study.space.initial());
    return "Model " + study.model_file.string() + ": " + kind_.describe(initial);
  }

 private:
  const SpecimenKind& kind_;
  bool is_stated_;  // true if the study states the kind; otherwise the file does
};

bool has_table(const Node& root, const char* key) {
  try {
    return root.find_table(key).has_value();
  } catch (const InputError&) {
    return false;  // the value is a text
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
    model.file = file_beside_study(table, "file", folder);
    kind = &experiment::kind_for_file(
        table.choice("kind", language.kind_names()), model.file, language.kinds);
  } else {
    if (!study.has("model") && study.has("tire") && study.has("target"))
      study.reject("tire",
                   "is measured data of a ring in the form of older versions; they are a study "
                   "now: latsch "
                   "new FOLDER --ring-data writes one to put them into");
    model.file = file_beside_study(study, "model", folder);
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

namespace {

/// Returns the conditions that the user excludes from a test by without = ["kappa"].
std::vector<std::string> left_out_of(const Node& table,
                                     const std::vector<experiment::MeasuredCondition>& conditions) {
  if (!table.has("without")) return {};
  std::vector<std::string> optional;
  for (const auto& condition : conditions)
    if (!condition.is_needed) optional.push_back(condition.channel);
  const auto without = table.texts("without");
  for (const std::string& name : without)
    if (std::find(optional.begin(), optional.end(), name) == optional.end())
      table.reject("without",
                   "has " + in_quotes(name) +
                       (optional.empty() ? ", but the test needs all its conditions"
                                         : ", expected one of " + list_of(optional)));
  return without;
}

/// Records that the measurement lacks a condition of the test. Throws if a column looks as if it
/// could be the condition.
void take_absent(const Node& table,
                 const experiment::MeasuredCondition& condition,
                 const Measurement& measurement,
                 const std::string& by) {
  const auto alike = measurement.columns_like(condition.channel, condition.unit);
  if (!alike.empty())
    table.reject(
        "from",
        fmt::format(
            "is {0}, which has no column {2}, so that it would be {3}. Column {1} may be it: "
            "if so, put {5} into [{4}]; if not, put without = [\"{2}\"] beside from",
            in_quotes(table.text("from")),
            in_quotes(alike.front()),
            condition.channel,
            condition.otherwise.empty() ? "left out" : "taken as " + condition.otherwise,
            table.text("from"),
            measurement.hint_for(condition.channel, alike.front(), condition.unit)));
  measurement.note_absent({condition.channel, condition.unit, by, condition.otherwise});
}

/// Throws InputError if a force or moment was measured in another frame than the one in which the
/// test prescribes it, or at another point of action.
void expect_frame(const Node& table,
                  const experiment::MeasuredCondition& condition,
                  const std::string& channel,
                  const std::string& frame) {
  if (frame.empty() || condition.frame.empty()) return;
  const bool is_same = condition.acts_at_origin ? frame == condition.frame
                                                : is_same_in(channel, frame, condition.frame);
  if (is_same) return;
  const auto point = [](const std::string& of) {
    return of == "W" ? "the contact patch" : "the wheel center";
  };
  const std::string from = table.text("from");
  const bool is_elsewhere = condition.acts_at_origin && (frame == "W") != (condition.frame == "W");
  // A table of both wheels has no inclination and radius of each, by which it could be turned.
  const bool is_of_a_wheel = channel.find('_') != channel.npos;
  const std::string at_point =
      fmt::format("say at = \"{}\" in the test", frame == "W" ? "contact_patch" : "wheel_center");
  const std::string turned =
      fmt::format("put in_frame = \"{}\" into [{}]{}",
                  condition.frame,
                  from,
                  is_elsewhere ? ", which needs its loaded_radius and gamma" : "");
  const std::string in_file =
      fmt::format("turn the columns of both wheels into axes {} in the file", condition.frame);
  table.reject("from",
               fmt::format("is {}, whose {} is in axes {}{}, but the test takes it in axes {}{}; "
                           "{}{}",
                           in_quotes(from),
                           channel,
                           frame,
                           is_elsewhere ? fmt::format(", at {}", point(frame)) : "",
                           condition.frame,
                           is_elsewhere ? fmt::format(", at {}", point(condition.frame)) : "",
                           is_elsewhere ? at_point + ", or " : "",
                           is_of_a_wheel ? in_file : turned));
}

/// Returns the measured conditions of a test, for {from = "measurement.NAME"}. `by` names the user
/// of the conditions for the ledger.
Channels measured_conditions(const Node& table,
                             const std::vector<experiment::MeasuredCondition>& conditions,
                             const Laboratory& laboratory,
                             const std::string& by) {
  const std::string from = table.text("from");
  std::vector<std::string> names;
  for (const auto& one : laboratory) names.push_back("measurement." + one->name());
  const auto found = std::find(names.begin(), names.end(), from);
  if (found == names.end())
    table.reject("from",
                 "is " + in_quotes(from) + ", which this study does not have" +
                     (names.empty() ? ": add a [measurement.NAME]"
                                    : did_you_mean(from, names) + "; there are " + list_of(names)));
  const Measurement& measurement = *laboratory[static_cast<std::size_t>(found - names.begin())];
  Channels channels;
  const auto without = left_out_of(table, conditions);
  for (const auto& condition : conditions) {
    const std::string channel =
        conditions.size() == 1 ? table.text("channel", condition.channel) : condition.channel;
    if (std::find(without.begin(), without.end(), condition.channel) != without.end()) continue;
    if (!condition.is_needed && !measurement.could_be(channel, condition.unit)) {
      if (condition.ignored.empty()) take_absent(table, condition, measurement, by);
      continue;
    }
    if (condition.ignored.empty())
      measurement.note_use(channel, by);
    else
      measurement.note_ignored(channel, by, condition.ignored);
    const auto& values = measurement.values(channel, condition.unit);
    const std::string frame = measurement.frame(channel);
    expect_frame(table, condition, channel, frame);
    channels.add({condition.channel, condition.unit, values});
  }
  return channels;
}

StudyTest read_study_test(const Node& table,
                          const fs::path& folder,
                          const Language& language,
                          const Laboratory& laboratory) {
  const auto measured = [&](const Node& from, const auto& conditions) {
    return measured_conditions(from, conditions, laboratory, "test " + table.name());
  };
  const bool is_inline = table.has("kind");
  if (is_inline && table.has("file"))
    table.reject("file", "is given beside kind, expected one of the two");
  const auto read_keys = [&](const Node& keys, const fs::path& beside) -> StudyTest {
    const DocumentRecord record(keys);
    auto read = language.read_identified_test(record.node(), {beside, measured});
    StudyTest test{
        table.name(), std::move(read.test), std::move(read.identity), std::move(read.files)};
    test.has_frame_key = record.keys().contains("frame");
    return test;
  };
  if (is_inline) return read_keys(table, folder);
  const fs::path file = file_beside_study(table, "file", folder);
  StudyTest test = read_keys(Document::read(file).root(), file.parent_path());
  test.files.insert(test.files.begin(), file);
  return test;
}

}  // namespace

std::vector<StudyTest> read_tests(const Node& study,
                                  const fs::path& folder,
                                  const SpecimenKind& kind,
                                  const Language& language,
                                  const Laboratory& laboratory) {
  std::vector<StudyTest> tests;
  for (const Node& table : study.named_tables("test")) {
    tests.push_back(read_study_test(table, folder, language, laboratory));
    if (const auto reason = reason_against(kind, *tests.back().test, language))
      table.reject(table.has("kind") ? "kind" : "file", *reason);
  }
  return tests;
}

std::vector<KnownChannel> known_channels(const std::vector<StudyTest>& tests) {
  std::vector<KnownChannel> channels;
  for (const StudyTest& test : tests) {
    for (const auto& channel : test.test->channels()) {
      const std::string name = test.name.empty() ? channel.name : test.name + "/" + channel.name;
      channels.push_back(
          {name, channel.unit, channel.frame, channel.regression, test.has_frame_key});
    }
  }
  return channels;
}

std::string test_of(const std::string& channel) { return channel.substr(0, channel.find('/')); }

std::string identity_of_tests(const std::vector<StudyTest>& tests,
                              const std::vector<std::string>& asked) {
  std::map<std::string, const StudyTest*> sorted;
  for (const StudyTest& test : tests)
    if (std::find(asked.begin(), asked.end(), test.name) != asked.end()) sorted[test.name] = &test;
  std::string text;
  for (const auto& [name, test] : sorted) {
    std::istringstream lines(test->identity);
    for (std::string line; std::getline(lines, line);) text += fmt::format("{}.{}\n", name, line);
  }
  return text;
}

}  // namespace latsch::correlation
