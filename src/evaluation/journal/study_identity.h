// SPDX-License-Identifier: Apache-2.0
// Identity of the study that a journal belongs to, as texts, so that a difference can be described
// in words.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace latsch {

/// One named text that the channels of a trial depend on: the model's file, the load cases, the
/// varied paths.
struct IdentityPart {
  std::string name;  // name of the part, one of the constants below
  std::string text;  // canonical text of what the part names

  bool operator==(const IdentityPart&) const = default;
};
/// Everything that the channels of a study's trials depend on. A journal accepts trials of one
/// identity.
using StudyIdentity = std::vector<IdentityPart>;

/// The model's numbers as canonical TOML (base/document_record.h).
inline constexpr const char* kModelPart = "model";
/// Every required test, with its resolved keys and the content of the files they name.
inline constexpr const char* kTestsPart = "tests";
/// Name of the tests part in older journals. It holds the text of test files as written; for tests
/// in the study itself it holds only some of the keys that the tests depend on.
inline constexpr const char* kOldTestsPart = "experiments";

/// Names of the parts that may change although the study does not: the version of the built-in
/// model, and the files of an outside program. The user can decide that the results are not
/// affected.
inline constexpr const char* kModelVersionPart = "model version";
/// Files of an outside program.
inline constexpr const char* kProgramFilesPart = "program files";

/// Returns the identity without the files of an outside program, for reading a journal if the
/// program is not installed.
StudyIdentity without_program_files(StudyIdentity identity);

/// True if the two identities differ in nothing but the version of the model, the files of an
/// outside program and parts of tests that journals of older versions lack.
bool is_same_but_for_versions(const StudyIdentity& journal, const StudyIdentity& study);

/// Returns the difference between the study of a journal and the present one, naming the part and
/// the line; nullopt if there is none.
std::optional<std::string> difference(const StudyIdentity& journal, const StudyIdentity& study);

}  // namespace latsch
