// SPDX-License-Identifier: Apache-2.0
#include "cli/console/forms.h"

#include <algorithm>

#include "base/error.h"

namespace latsch::cli {
namespace {

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

bool has_effect(const Form& form, const std::string& option) {
  return contains(form.chosen_by, option) || contains(form.takes, option);
}

/// Returns those of the given options that choose the form of the verb.
std::vector<std::string> choosers(const Form& form, const std::vector<std::string>& given) {
  std::vector<std::string> names;
  for (const std::string& name : given)
    if (contains(form.chosen_by, name)) names.push_back(name);
  return names;
}

std::vector<const Form*> chosen_forms(const std::vector<Form>& forms,
                                      const std::vector<std::string>& given) {
  std::vector<const Form*> chosen;
  for (const Form& form : forms)
    if (!choosers(form, given).empty()) chosen.push_back(&form);
  if (!chosen.empty()) return chosen;
  for (const Form& form : forms)
    if (form.chosen_by.empty()) chosen.push_back(&form);
  return chosen;
}

/// Returns "a, b and c".
std::string joined(const std::vector<std::string>& words, const std::string& last) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i)
    text += (i == 0 ? "" : i + 1 < words.size() ? ", " : " " + last + " ") + words[i];
  return text;
}

std::string in_words(const std::vector<const Form*>& forms) {
  std::vector<std::string> words;
  for (const Form* form : forms) words.push_back(form->in_words);
  return joined(words, "and");
}

/// Returns the options that choose a form in which `option` has an effect.
std::vector<std::string> ways_to(const std::string& option, const std::vector<Form>& forms) {
  std::vector<std::string> ways;
  for (const Form& form : forms)
    if (has_effect(form, option))
      for (const std::string& way : form.chosen_by)
        if (way != option && !contains(ways, way)) ways.push_back(way);
  return ways;
}

}  // namespace

void check_forms(const std::string& verb,
                 const std::vector<Form>& forms,
                 const std::vector<std::string>& given) {
  if (forms.empty()) return;
  const std::vector<const Form*> chosen = chosen_forms(forms, given);
  if (chosen.size() > 1 &&
      std::any_of(chosen.begin(), chosen.end(), [](const Form* form) { return form->alone; })) {
    std::vector<std::string> each;
    for (const Form* form : chosen)
      each.push_back(choosers(*form, given).front() + " " + form->in_words);
    throw InputError(verb + ": " + joined(each, "and") + "; expected one of them");
  }
  for (const std::string& option : given) {
    const auto takes = [&](const Form& form) { return has_effect(form, option); };
    // the option belongs to all forms
    if (std::none_of(forms.begin(), forms.end(), takes)) continue;
    if (std::any_of(chosen.begin(), chosen.end(), [&](const Form* form) { return takes(*form); }))
      continue;
    const std::vector<std::string> ways = ways_to(option, forms);
    throw InputError(verb + ": " + option + " has no effect here" +
                     (chosen.empty() ? "" : ", because this command " + in_words(chosen)) +
                     (ways.empty() ? "; expected the command without " + option
                                   : "; expected " + option + " beside " + joined(ways, "or") +
                                         ", or the command without it"));
  }
}

}  // namespace latsch::cli
