// SPDX-License-Identifier: Apache-2.0
// Tests that the table of keys contains every key that a reader of a study requests, with a
// description, and no other key.
#include "correlation/study_keys.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <optional>

#include "base/units.h"
#include "correlation/study/spring_testing.h"

namespace latsch::correlation {
namespace {

using experiment::KeyTable;
using experiment::TabledKey;

const TabledKey* find(const KeyTable& table, const std::string& heading, const std::string& path) {
  for (const auto& [section, keys] : table.sections())
    for (const TabledKey& key : keys)
      if (section->heading == heading && key.words.path == path) return &key;
  return nullptr;
}

const KeyTable& shipped() {
  static const KeyTable table = read_study_keys(experiment::language());
  return table;
}

TEST(StudyKeysTest, EveryKeyOfEverySectionHasASentenceAndASampleThatStatesIt) {
  EXPECT_GT(shipped().sections().size(), 40u);
  for (const std::string& fault : shipped().faults()) ADD_FAILURE() << fault;
}

TEST(StudyKeysTest, SentencesAreSentences) {
  for (const auto& [section, keys] : shipped().sections())
    for (const TabledKey& key : keys) {
      const std::string& sentence = key.words.sentence;
      EXPECT_TRUE(sentence.ends_with('.')) << section->heading << " " << key.words.path;
      EXPECT_EQ(sentence.find('|'), sentence.npos) << "ends a cell of the page: " << sentence;
    }
}

TEST(StudyKeysTest, AKeyIsDeclaredByItsReader) {
  const TabledKey* tolerance = find(shipped(), "[optimizer]", "step_tolerance");
  ASSERT_TRUE(tolerance);
  EXPECT_FALSE(tolerance->is_required);
  EXPECT_EQ(tolerance->forms.front().kind, DeclaredKey::Kind::quantity);
  const TabledKey* channel = find(shipped(), "[constraint.NAME]: on channels", "channel");
  ASSERT_TRUE(channel);
  EXPECT_TRUE(channel->is_required);
  const TabledKey* scale = find(shipped(), "[variable.NAME]", "scale");
  ASSERT_TRUE(scale);
  EXPECT_EQ(scale->forms.front().choices, (std::vector<std::string>{"linear", "logarithmic"}));
  EXPECT_EQ(scale->defaults, std::vector<std::string>{"\"linear\""});
  EXPECT_TRUE(find(shipped(), "Test \"modes\": frequencies and shapes", "points")->is_measurable);
}

/// Returns the number of a default in SI; nullopt if it is no number.
std::optional<double> number_of(std::string text) {
  std::erase(text, '"');
  char* end = nullptr;
  const double plain = std::strtod(text.c_str(), &end);
  if (end != text.c_str() && *end == '\0') return plain;
  const auto quantity = parse_quantity(text);
  return quantity ? std::optional(quantity->si) : std::nullopt;
}

bool takes(const experiment::KeyForm& form, double number) {
  const bool above =
      form.range.lower_excluded ? number > form.range.lower : number >= form.range.lower;
  return above && number <= form.range.upper;
}

// A default outside of the range that its reader accepts would mean that the program chooses the
// value; the page must then say which. Regression test: `population` had the default 0 and the
// range 4 to 1000000.
TEST(StudyKeysTest, EveryDefaultIsAValueThatItsReaderTakes) {
  int numbers = 0;
  for (const auto& [section, keys] : shipped().sections()) {
    for (const TabledKey& key : keys) {
      if (!key.words.otherwise.empty()) continue;  // the page says which value the program chooses
      for (const std::string& text : key.defaults) {
        const auto number = number_of(text);
        if (!number) continue;
        ++numbers;
        EXPECT_TRUE(std::any_of(key.forms.begin(),
                                key.forms.end(),
                                [&](const auto& form) { return takes(form, *number); }))
            << section->heading << " " << key.words.path << " = " << text;
      }
    }
  }
  EXPECT_GT(numbers, 80);
  const TabledKey* population = find(shipped(), "[optimizer]", "population");
  ASSERT_TRUE(population);
  EXPECT_TRUE(population->defaults.empty());
  EXPECT_EQ(population->words.otherwise, "ten for each variable, at least 20");
}

// Regression test: the page listed max_steps as a key of the study itself, where its reader refuses
// it.
TEST(StudyKeysTest, AKeyIsListedInTheTableWhereItsReaderTakesIt) {
  EXPECT_FALSE(find(shipped(), "A study", "max_steps"));
  EXPECT_TRUE(find(shipped(), "[optimizer]", "max_steps"));
  EXPECT_TRUE(find(shipped(), "[stage.NAME]: one fit after the other", "max_steps"));
  EXPECT_FALSE(find(shipped(), "[run]", "seed"));
}

TEST(StudyKeysTest, AProgramOfItsOwnHasTheSectionsOfItsOwnTests) {
  const KeyTable table = read_study_keys(experiment::spring_language());
  for (const auto& [section, keys] : table.sections())
    EXPECT_FALSE(section->heading.starts_with("Test ")) << section->heading;
  const TabledKey* kind = find(table, "model, [model]", "kind");
  ASSERT_TRUE(kind);
  EXPECT_EQ(kind->forms.front().choices, std::vector<std::string>{"spring"});
}

}  // namespace
}  // namespace latsch::correlation
