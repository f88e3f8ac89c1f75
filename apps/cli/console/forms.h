// SPDX-License-Identifier: Apache-2.0
// The forms of a verb, and the options that have an effect in each form. An option without effect
// in the chosen form is refused, because the user expects an effect.
#pragma once

#include <string>
#include <vector>

namespace latsch::cli {

/// One way to use a verb. Options are named by their long name, "--drum", positional arguments by
/// theirs, "points". An option that no form of a verb contains belongs to all forms.
struct Form {
  std::string in_words;  // predicate with the verb as subject: "writes a study of a car"
  /// Options that choose the form; if there are none, the form applies if no other form is chosen.
  std::vector<std::string> chosen_by;
  std::vector<std::string> takes = {};  // further options that have an effect
  bool alone = true;                    // cannot be combined with another form
};

/// Throws InputError if the given options choose two forms that exclude each other, or if an option
/// belongs only to forms that are not chosen.
void check_forms(const std::string& verb,
                 const std::vector<Form>& forms,
                 const std::vector<std::string>& given);

}  // namespace latsch::cli
