// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <chrono>

#include "studio/views/json_values.h"
#include "studio/views/views.h"

namespace latsch::studio {
namespace {

/// Converts a file time to seconds since 1970.
double unix_time(std::filesystem::file_time_type time) {
  const auto system = std::chrono::file_clock::to_sys(time);
  return std::chrono::duration<double>(system.time_since_epoch()).count();
}

Json row(const ShelvedStudy& study) {
  return study.look([&](const ShelvedStudy::Sight& sight) {
    Json row{{"study", study.id()}, {"title", study.id()}, {"state", name(sight.state)}};
    row["error"] = sight.error;
    if (!sight.study) return row;
    row["title"] = sight.study->title;
    row["variables"] = sight.study->space.size();
    row["experiments"] = sight.study->experiments.size();
    row["trials"] = std::max(sight.of_another_study, sight.table->total());
    row["failed"] = sight.table->failed();
    row["foreign"] =
        sight.of_another_study > 0 ? sight.of_another_study : sight.table->counts_read().foreign;
    const auto best = sight.table->best();
    const auto& target = sight.table->target();
    row["best"] =
        best ? finite(target.weighting(target.weights()).target(*sight.table->rows()[*best].parts))
             : Json(nullptr);
    row["changed"] = unix_time(sight.changed);
    row["reading"] = sight.table->has_more() && sight.error.empty();
    return row;
  });
}

}  // namespace

Json home_view(const Shelf& shelf, const std::string& version, bool has_page) {
  Json view{{"version", version}, {"folder", shelf.folder().string()}, {"has_page", has_page}};
  const auto [done, total] = shelf.read_so_far();
  view["loading"] = done < total ? Json{{"done", done}, {"total", total}} : Json(nullptr);
  view["studies"] = Json::array();
  for (const auto& study : shelf.studies()) view["studies"].push_back(row(*study));
  return view;
}

}  // namespace latsch::studio
