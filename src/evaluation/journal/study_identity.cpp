// SPDX-License-Identifier: Apache-2.0
#include "evaluation/journal/study_identity.h"

#include <fmt/format.h>

#include <sstream>

#include "base/document.h"
#include "base/document_record.h"
namespace latsch {
namespace {

/// Finds the first line that differs and returns a text such as "line 12: it has `a`, the study has
/// `b`".
std::string first_difference(const std::string& journal, const std::string& study) {
  std::istringstream theirs(journal);
  std::istringstream ours(study);
  for (int line = 1;; ++line) {
    std::string a, b;
    const bool more_a = static_cast<bool>(std::getline(theirs, a));
    const bool more_b = static_cast<bool>(std::getline(ours, b));
    if (!more_a && !more_b) return "its line ends";
    if (a == b && more_a == more_b) continue;
    return fmt::format("line {}: the journal has `{}`, the study has `{}`",
                       line,
                       more_a ? a : "(end)",
                       more_b ? b : "(end)");
  }
}

const IdentityPart* find(const StudyIdentity& identity, const std::string& name) {
  for (const IdentityPart& part : identity)
    if (part.name == name) return &part;
  return nullptr;
}

bool is_version(const IdentityPart& part) {
  return part.name == kModelVersionPart || part.name == kProgramFilesPart;
}

/// True if a journal describes its tests in the format of older versions of the program.
bool tells_old_tests(const StudyIdentity& journal) {
  return find(journal, kOldTestsPart) && !find(journal, kTestsPart);
}

/// Returns the model of a journal in today's form. Older journals hold the text of its file.
std::string model_of(const IdentityPart& part) {
  try {
    return canonical_text(Document::parse(part.text, "journal"));
  } catch (const InputError&) {
    // The text cannot be read, so the journal is damaged, and differs.
    return part.text;
  }
}

bool is_same(const IdentityPart& journal, const IdentityPart& study) {
  return journal.text == study.text ||
         (study.name == kModelPart && model_of(journal) == study.text);
}

}  // namespace

StudyIdentity without_program_files(StudyIdentity identity) {
  std::erase_if(identity, [](const auto& part) { return part.name == kProgramFilesPart; });
  return identity;
}

bool is_same_but_for_versions(const StudyIdentity& journal, const StudyIdentity& study) {
  StudyIdentity a = journal, b = study;
  std::erase_if(a, is_version);
  std::erase_if(b, is_version);
  if (tells_old_tests(a)) {
    std::erase_if(a, [](const auto& part) { return part.name == kOldTestsPart; });
    std::erase_if(b, [](const auto& part) { return part.name == kTestsPart; });
  }
  return !difference(a, b);
}

std::optional<std::string> difference(const StudyIdentity& journal, const StudyIdentity& study) {
  for (const IdentityPart& part : study) {
    const IdentityPart* other = find(journal, part.name);
    if (!other && is_version(part))
      return fmt::format("it is older and does not contain its \"{}\"", part.name);
    if (!other && part.name == kTestsPart && tells_old_tests(journal))
      return "it is older and does not contain every key of its tests and the content of every "
             "file they name";
    if (!other) return fmt::format("it has no \"{}\"", part.name);
    if (!is_same(*other, part))
      return fmt::format(
          "\"{}\" differs in {}",
          part.name,
          first_difference(part.name == kModelPart ? model_of(*other) : other->text, part.text));
  }
  for (const IdentityPart& part : journal) {
    if (!find(study, part.name)) return fmt::format("it has \"{}\", the study does not", part.name);
  }
  return std::nullopt;
}

}  // namespace latsch
