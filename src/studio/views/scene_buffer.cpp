// SPDX-License-Identifier: Apache-2.0
#include "studio/views/scene_buffer.h"

#include <cstring>

#include "report/report.h"
#include "report/tire_section.h"
#include "studio/views/json_values.h"

namespace latsch::studio {
namespace {

/// Lists of four-byte numbers stored in one buffer, and the position at which each list begins.
class Buffer {
 public:
  template <class Number>
  Json add(const std::vector<Number>& numbers) {
    static_assert(sizeof(Number) == 4);
    Json at{{"at", bytes_.size()}, {"count", numbers.size()}};
    const auto* begin = reinterpret_cast<const char*>(numbers.data());
    bytes_.append(begin,
                  // the least significant byte comes first, as in memory on x86 and ARM
                  numbers.size() * sizeof(Number));
    return at;
  }
  /// Returns the length of the JSON head, the head padded with blanks to a multiple of four bytes,
  /// and the numbers.
  std::string behind(const Json& head) const {
    std::string text = head.dump();
    text.append((4 - text.size() % 4) % 4, ' ');
    const auto length = static_cast<std::uint32_t>(text.size());
    std::string all(sizeof length, '\0');
    std::memcpy(all.data(), &length, sizeof length);
    return all + text + bytes_;
  }

 private:
  std::string bytes_;
};

std::vector<float> millimeters(const Eigen::Matrix3Xd& points) {
  std::vector<float> numbers;
  numbers.reserve(static_cast<std::size_t>(points.size()));
  for (const double x : points.reshaped()) numbers.push_back(static_cast<float>(1e3 * x));
  return numbers;
}

Json ranges(const std::vector<report::Scene::Part>& parts) {
  Json all = Json::array();
  for (const auto& part : parts)
    all.push_back({{"name", part.name}, {"first", part.first}, {"count", part.count}});
  return all;
}

/// Returns the lists of a sequence: for each quantity that changes from step to step, its values at
/// all steps in one list.
Json sequence_of(const report::Scene::Sequence& sequence, Buffer& buffer) {
  std::vector<float> points, field, vectors;
  Json at = Json::array(), origins = Json::array(), arrows = Json::array();
  for (const auto& arrow : sequence.arrows)
    arrows.push_back({{"name", arrow.name},
                      {"unit", arrow.unit},
                      {"point", arrow.point},
                      {"is_load", arrow.is_load}});
  for (const auto& step : sequence.steps) {
    at.push_back(finite(step.at));
    origins.push_back(finite(1e3 * step.origin));
    const std::vector<float> now = millimeters(step.points);
    points.insert(points.end(), now.begin(), now.end());
    field.insert(field.end(), step.field.begin(), step.field.end());
    for (const double value : step.vectors.reshaped()) vectors.push_back(static_cast<float>(value));
  }
  return {{"name", sequence.name},
          {"mesh", sequence.mesh},
          {"along", sequence.along},
          {"unit", sequence.unit},
          {"at", at},
          {"origins", origins},
          {"points", buffer.add(points)},
          {"field",
           field.empty() ? Json(nullptr)
                         : Json{{"name", sequence.field_name},
                                {"unit", sequence.field_unit},
                                {"values", buffer.add(field)}}},
          {"arrows", arrows},
          {"vectors", buffer.add(vectors)},
          {"ground", sequence.ground.empty() ? Json(nullptr) : Json(sequence.ground)}};
}

}  // namespace

std::string scene_buffer(const report::Scene& scene, const std::string& title) {
  Buffer buffer;
  Json head{{"title", title},
            {"unit", "mm"},
            {"meshes", Json::array()},
            {"frames", Json::array()},
            {"sequences", Json::array()},
            {"remarks", scene.remarks}};
  for (const auto& mesh : scene.meshes)
    head["meshes"].push_back({{"name", mesh.name},
                              {"points", buffer.add(millimeters(mesh.points))},
                              {"triangles", buffer.add(mesh.triangles)},
                              {"edges", buffer.add(mesh.edges)},
                              {"parts", ranges(mesh.parts)},
                              {"rods", ranges(mesh.rods)}});
  for (const auto& frame : scene.frames) {
    Json field = nullptr;
    if (!frame.field.empty())
      field = {{"name", frame.field_name},
               {"unit", frame.field_unit},
               {"values", buffer.add(frame.field)}};
    head["frames"].push_back(
        {{"name", frame.name},
         {"mesh", frame.mesh},
         {"points", buffer.add(millimeters(frame.points))},
         {"field", field},
         {"swing", frame.swing.cols() == 0 ? Json(nullptr) : buffer.add(millimeters(frame.swing))},
         {"frequency", frame.frequency > 0.0 ? finite(frame.frequency) : Json(nullptr)},
         {"ground", frame.ground ? finite(1e3 * *frame.ground) : Json(nullptr)}});
  }
  for (const auto& sequence : scene.sequences)
    head["sequences"].push_back(sequence_of(sequence, buffer));
  return buffer.behind(head);
}

Json section_of(const report::TirePictures& pictures, const std::string& title) {
  const report::TireSection section = report::tire_section(pictures);
  constexpr double kMillimeter = 1e-3;
  const auto line = [](const std::vector<Eigen::Vector2d>& points) {
    Json y = Json::array(), z = Json::array();
    for (const Eigen::Vector2d& point : points) {
      y.push_back(finite(point.x() / kMillimeter));
      z.push_back(finite(point.y() / kMillimeter));
    }
    return std::pair(y, z);
  };
  Json view{
      {"title", title}, {"unit", "mm"}, {"polygons", Json::array()}, {"cords", Json::array()}};
  for (const auto& polygon : section.polygons) {
    const auto [y, z] = line(polygon.corners);
    view["polygons"].push_back({{"part", polygon.part}, {"y", y}, {"z", z}});
  }
  for (const auto& cord : section.cords) {
    const auto [y, z] = line(cord.corners);
    view["cords"].push_back({{"part", cord.part}, {"y", y}, {"z", z}});
  }
  return view;
}

}  // namespace latsch::studio
