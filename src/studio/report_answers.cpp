// SPDX-License-Identifier: Apache-2.0
#include "studio/report_answers.h"

#include <zlib.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <stdexcept>

#include "base/error.h"
#include "studio/base64.h"
#include "studio/shelf/study_file.h"
#include "studio/views/scene_buffer.h"
#include "studio/views/views.h"

namespace latsch::studio {
namespace {

constexpr long kConvergencePoints = 3000;
constexpr long kRows = 100;

/// Rounds positions of a scene to multiples of 1/64: finer differences are not visible, and equal
/// bits compress well.
std::string rounded(std::string scene) {
  constexpr float kSteps = 64.0F;
  std::uint32_t head = 0;
  std::memcpy(&head, scene.data(), sizeof head);
  const Json json = Json::parse(scene.substr(sizeof head, head));
  char* numbers = scene.data() + sizeof head + head;
  const auto round_all = [&](const Json& list) {
    if (list.is_null()) return;
    char* at = numbers + list["at"].get<std::size_t>();
    for (std::size_t k = 0; k < list["count"].get<std::size_t>(); ++k, at += sizeof(float)) {
      float value = 0.0F;
      std::memcpy(&value, at, sizeof value);
      value = std::round(value * kSteps) / kSteps;
      std::memcpy(at, &value, sizeof value);
    }
  };
  for (const Json& mesh : json["meshes"]) round_all(mesh["points"]);
  for (const Json& frame : json["frames"]) {
    round_all(frame["points"]);
    round_all(frame["swing"]);
  }
  for (const Json& sequence : json["sequences"])
    // steps along other quantities are drawn magnified, so they keep their digits
    if (sequence["along"] == "time") round_all(sequence["points"]);
  return scene;
}

/// Compresses bytes to the gzip format [RFC 1952].
std::string gzip(const std::string& bytes) {
  z_stream stream{};
  constexpr int kWindow = 15 + 16;  // largest window; + 16 selects the gzip header
  if (deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, kWindow, 9, Z_DEFAULT_STRATEGY) != Z_OK)
    throw std::runtime_error("no memory to compress with");
  std::string out(deflateBound(&stream, bytes.size()), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  deflate(&stream, Z_FINISH);
  out.resize(stream.total_out);
  deflateEnd(&stream);
  return out;
}

}  // namespace

std::string report_answers(const std::filesystem::path& file,
                           const experiment::Language& language,
                           const report::StudyReport& drawn) {
  ShelvedStudy study(file.filename().string(), std::filesystem::absolute(file), language);
  study.ignore_runs();
  constexpr long kAll = 1'000'000'000;
  study.refresh(kAll);
  while (study.has_more()) study.refresh(kAll);
  study.find_ending();
  StudyRuns no_runs("");
  Json answers = Json::object();
  const auto hold = [&](const std::string& request, const std::function<Json()>& view) {
    try {
      answers[request] = view();
    } catch (const InputError&) {  // the view has nothing to show for this study
    }
  };
  hold("study", [&] { return study_view(study, no_runs); });
  hold("convergence", [&] { return convergence_view(study, {.most = kConvergencePoints}, ""); });
  hold("trials", [&] { return trials_view(study, {1, kRows, true}, ""); });
  hold("comparison", [&] { return comparison_view(study, "best"); });
  hold("limits", [&] { return limits_view(study, "best"); });
  hold("target", [&] { return target_view(study, ""); });
  hold("kpis", [&] { return kpi_view(study, ""); });
  hold("identifiability", [&] { return identifiability_view(study); });
  hold("model", [&] { return model_view(study); });
  hold("file", [&] {
    const StudyText text = read_study_text(file);
    return Json{{"text", text.text}, {"version", text.version}};
  });
  const std::string title = "best trial";
  if (drawn.pictures) answers["section"] = section_of(*drawn.pictures, title);
  hold("scene", [&] {
    const std::string scene = drawn.pictures
                                  ? scene_buffer(report::scene_of(*drawn.pictures), title)
                                  : scene_view(study, "best");
    return Json{{"gzip_base64", base64(gzip(rounded(scene)))}};
  });
  return answers.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace latsch::studio
