// SPDX-License-Identifier: Apache-2.0
#include "experiment/language.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/document_record.h"
#include "base/text.h"
#include "experiment/kinds/specimen_kinds.h"
#include "experiment/language/key_section.h"
#include "experiment/language/known_limits.h"
#include "experiment/language/model_file.h"
#include "experiment/tests/test_kinds.h"

namespace latsch::experiment {

const Language& language() {
  static const Language all = {{&fe_tire_kind(),
                                &inp_tire_kind(),
                                &ring_tire_kind(),
                                &rigid_ring_kind(),
                                &magic_formula_kind(),
                                &suspension_kind(),
                                &car_kind()},
                               {&kDrumCleatTest,
                                &kSlipSweepTest,
                                &kRollingStiffnessTest,
                                &kUniformityTest,
                                &kStaticStiffnessTest,
                                &kFootprintTest,
                                &kModesTest,
                                &kSteadyStatesTest,
                                &kSlipHistoryTest,
                                &kLoadDeflectionTest,
                                &kKcTest,
                                &kKinematicsTest,
                                &kFourPostTest,
                                &kKerbTest,
                                &kAxleKcTest,
                                &kMassPropertiesTest,
                                &kInflationTest,
                                &kRollingTest,
                                &kRollingFootprintTest,
                                &kRollingChainTest,
                                &kResponseTest,
                                &kRollingResponseTest}};
  return all;
}

std::vector<std::string> Language::kind_names() const {
  std::vector<std::string> names;
  for (const SpecimenKind* kind : kinds) names.push_back(kind->name());
  return names;
}

std::vector<std::string> Language::test_names() const {
  std::vector<std::string> names;
  for (const TestKind* kind : tests) names.push_back(kind->name);
  return names;
}

const SpecimenKind* Language::find_kind(const std::string& name) const {
  for (const SpecimenKind* kind : kinds)
    if (kind->name() == name) return kind;
  return nullptr;
}

const TestKind* Language::find_test(const std::string& name) const {
  for (const TestKind* test : tests)
    if (test->name == name) return test;
  return nullptr;
}

const SpecimenKind& Language::kind_of_file(const std::filesystem::path& file) const {
  if (is_document(file)) {
    const Document document = Document::read(file);
    if (document.root().has("kind"))
      return *find_kind(document.root().choice("kind", kind_names()));
  }
  for (const SpecimenKind* kind : kinds)
    if (kind->recognizes(file)) return *kind;
  throw InputError({file.string(), 0},
                   "does not say what model it is, expected kind = one of " +
                       list_of(kind_names()) + ", or a .tir or .inp file");
}

std::unique_ptr<Test> Language::read_test(const std::filesystem::path& file,
                                          const MeasuredConditions& measured) const {
  return read_test(Document::read(file).root(), {file.parent_path(), measured});
}

namespace {

const TestKind& kind_of(const Language& language, const Node& keys) {
  const std::string name = keys.choice("kind", language.test_names());
  return **std::find_if(language.tests.begin(), language.tests.end(), [&](const TestKind* test) {
    return test->name == name;
  });
}

}  // namespace

std::unique_ptr<Test> Language::read_test(const Node& keys, const TestSource& source) const {
  const TestKind& kind = kind_of(*this, keys);
  if (kind.keys) refuse_unknown_keys(keys, kind.keys());
  auto test = kind.read(keys, source);
  keys.close();
  return test;
}

ReadTest Language::read_identified_test(const std::filesystem::path& file,
                                        const MeasuredConditions& measured) const {
  return read_identified_test(Document::read(file).root(), {file.parent_path(), measured});
}

ReadTest Language::read_identified_test(const Node& keys, const TestSource& source) const {
  const DocumentRecord record(keys);
  const TestKind& kind = kind_of(*this, record.node());
  auto test = read_test(record.node(), source);
  const std::string scheme = kind.scheme.empty() ? "" : "scheme: " + kind.scheme + "\n";
  return {std::move(test), record.text() + scheme, record.files()};
}

std::vector<std::string> Language::kinds_for(const std::vector<std::string>& needs) const {
  std::vector<std::string> names;
  for (const SpecimenKind* kind : kinds)
    if (can(*kind, needs)) names.push_back(kind->name());
  return names;
}

bool can(const SpecimenKind& kind, const Test& test) { return can(kind, test.needs()); }

bool can(const SpecimenKind& kind, const std::vector<std::string>& needs) {
  const auto has = kind.abilities();
  return std::any_of(needs.begin(), needs.end(), [&](const std::string& one) {
    return std::find(has.begin(), has.end(), one) != has.end();
  });
}

namespace {

void check_ability(const Language& language, const SpecimenKind& kind, const Test& test) {
  if (can(kind, test)) return;
  throw InputError("a " + kind.in_words() + " cannot do this test (" + test.in_words() +
                   "): it takes a model that " + test.needs().front() + ", such as " +
                   list_of(language.kinds_for(test.needs())));
}

}  // namespace

namespace {

/// Returns a Failure for the first value that is NaN; `before` samples were recorded in earlier
/// blocks.
Status check_numbers(const Channels& channels, std::size_t before = 0) {
  for (const Channel& channel : channels.all())
    for (std::size_t i = 0; i < channel.values.size(); ++i)
      if (std::isnan(channel.values[i]))
        return Failure{fmt::format(
            "{} is not a number at sample {}: the model's equations have no value there, so this "
            "test has no result",
            channel.name,
            before + i + 1)};
  return {};
}

/// Thrown to carry a Failure out of a test that passes on its channels block by block.
struct NotANumber {
  Failure failure;
};

}  // namespace

Result<Channels> Language::run(const SpecimenKind& kind,
                               const Document& numbers,
                               const Test& test) const {
  check_ability(*this, kind, test);
  auto recorded = test.run(*kind.build(numbers));
  if (!recorded) return recorded;
  if (const Status done = check_numbers(*recorded); !done) return done.failure();
  return recorded;
}

Result<std::vector<std::string>> Language::run_in_blocks(
    const SpecimenKind& kind,
    const Document& numbers,
    const Test& test,
    const std::function<void(const Channels&)>& tell) const {
  check_ability(*this, kind, test);
  std::size_t before = 0;
  const auto specimen = kind.build(numbers);
  try {
    auto notes = test.run_in_blocks(*specimen, [&](const Channels& block) {
      if (const Status done = check_numbers(block, before); !done) throw NotANumber{done.failure()};
      before += block.empty() ? 0 : block.all().front().values.size();
      tell(block);
    });
    if (notes)
      for (std::string& limit : limits_met(*specimen)) notes->push_back(std::move(limit));
    return notes;
  } catch (const NotANumber& found) {
    return found.failure;
  }
}

}  // namespace latsch::experiment
