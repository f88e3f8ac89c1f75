// SPDX-License-Identifier: Apache-2.0
// Which study a journal belongs to, as texts, so that a difference can be told in words.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace latsch {

/// One named text that the channels of a trial depend on: the model's file, the load cases, the
/// paths that vary.
struct IdentityPart {
  std::string name;
  std::string text;

  bool operator==(const IdentityPart&) const = default;
};
using StudyIdentity = std::vector<IdentityPart>;

/// The model's numbers as canonical TOML (base/document_record.h).
inline constexpr const char* kModelPart = "model";
/// Every test that is asked for, by its resolved keys and the content of the files they name.
inline constexpr const char* kTestsPart = "tests";
/// The part that stood in its place in older journals: files of tests as they were written, and of
/// tests in the study itself less than they depend on.
inline constexpr const char* kOldTestsPart = "experiments";

/// Parts that change where a study does not: the model of this program or an outside program has
/// become another one. A person may know that its results have not.
inline constexpr const char* kModelVersionPart = "model version";
inline constexpr const char* kProgramFilesPart = "program files";

/// The same without the files of an outside program: for reading, also where it is not installed.
StudyIdentity without_program_files(StudyIdentity identity);

/// Whether nothing differs but those parts, and what an older journal does not say of its tests.
bool is_same_but_for_versions(const StudyIdentity& journal, const StudyIdentity& study);

/// What differs between the study of a journal and the one at hand, naming the part and the line;
/// nullopt where nothing does.
std::optional<std::string> difference(const StudyIdentity& journal, const StudyIdentity& study);

}  // namespace latsch
