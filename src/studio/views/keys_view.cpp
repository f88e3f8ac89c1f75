// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "correlation/study_keys.h"
#include "studio/views/views.h"

namespace latsch::studio {
namespace {

Json key_view(const experiment::TabledKey& key) {
  Json choices = Json::array();
  for (const experiment::KeyForm& form : key.forms)
    for (const std::string& choice : form.choices)
      if (std::find(choices.begin(), choices.end(), choice) == choices.end())
        choices.push_back(choice);
  return {{"sentence", key.words.sentence}, {"choices", std::move(choices)}};
}

}  // namespace

Json keys_view(const experiment::Language& language) {
  Json tables = Json::object();
  const experiment::KeyTable all = correlation::read_study_keys(language);
  for (const auto& [section, keys] : all.sections()) {
    const std::string& table = section->below;
    if (table.empty() || table.find('*') != table.npos) continue;
    for (const experiment::TabledKey& key : keys) tables[table][key.words.path] = key_view(key);
  }
  return tables;
}

}  // namespace latsch::studio
