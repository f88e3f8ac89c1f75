// SPDX-License-Identifier: Apache-2.0
#include "cli/run/test_argument.h"

#include "base/document.h"
#include "cli/console/implausible.h"

namespace latsch::cli {

experiment::ReadTest test_argument(const std::string& text, const experiment::Language& language) {
  if (!text.starts_with('{')) {
    auto test = language.read_identified_test(text);
    reject_impossible(experiment::unusual_numbers(Document::read(text), "test"));
    return test;
  }
  const Document keys = Document::parse("test = " + text, "the test in braces");
  auto test = language.read_identified_test(keys.root().table("test"), {});
  reject_impossible(experiment::unusual_numbers(keys));
  return test;
}

}  // namespace latsch::cli
