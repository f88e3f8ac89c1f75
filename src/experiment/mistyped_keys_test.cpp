// SPDX-License-Identifier: Apache-2.0
// A mistyped key of a test is named as such, also if the test lacks keys that it needs.
#include <gtest/gtest.h>

#include <string>

#include "base/document.h"
#include "base/error.h"
#include "experiment/language.h"

namespace latsch::experiment {
namespace {

std::string complaint_about(const std::string& text) {
  const Document document = Document::parse(text, "t.toml");
  try {
    language().read_test(document.root(), {});
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(MistypedKeys, AreNamedBeforeMissingOnesForEveryKindOfTest) {
  int kinds = 0;
  for (const TestKind* kind : language().tests) {
    if (!kind->keys) continue;
    ++kinds;
    const std::string text = "kind = \"" + kind->name + "\"\nlod_of_nothing = \"4 kN\"\n";
    EXPECT_EQ(complaint_about(text).rfind("t.toml:2: unknown key \"lod_of_nothing\"", 0), 0u)
        << kind->name << ": " << complaint_about(text);
  }
  EXPECT_GE(kinds, 10);
}

TEST(MistypedKeys, OfferTheKeyThatIsMeant) {
  EXPECT_EQ(complaint_about("kind = \"rolling\"\nfrcition = 0.5\nlods = [\"4 kN\"]\n")
                .rfind("t.toml:2: unknown key \"frcition\", did you mean \"friction\"?", 0),
            0u);
}

}  // namespace
}  // namespace latsch::experiment
