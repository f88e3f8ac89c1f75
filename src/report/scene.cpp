// SPDX-License-Identifier: Apache-2.0
#include "report/scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "base/text.h"
#include "report/report.h"

namespace latsch::report {
namespace {

constexpr int kMostModesShown = 12;
constexpr double kAmplitude = 0.09;  // share of the outer radius, amplitude of drawn modes

constexpr std::array<std::array<int, 4>, 6> kBrickFaces = {
    {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};

struct OuterFace {
  std::array<int, 4> nodes;
  int region;
};

/// Returns the outer faces of the mesh: those that belong to one element only.
std::vector<OuterFace> outer_faces(const fe_tire::Mesh& mesh) {
  std::map<std::array<int, 4>, std::pair<int, OuterFace>> seen;
  for (int s = 0; s < mesh.sectors; ++s) {
    for (const fe_tire::Element& element : mesh.elements) {
      for (const auto& face : kBrickFaces) {
        std::array<int, 4> nodes;
        for (std::size_t k = 0; k < 4; ++k)
          nodes[k] = (s * mesh.nodes_per_sector() + element.node[face[k]]) % mesh.nodes();
        std::array<int, 4> key = nodes;
        std::sort(key.begin(), key.end());
        auto& [count, first] = seen[key];
        ++count;
        first = {nodes, element.region};
      }
    }
  }
  std::vector<OuterFace> faces;
  for (const auto& [key, face] : seen)
    if (face.first == 1) faces.push_back(face.second);
  std::stable_sort(faces.begin(), faces.end(), [](const OuterFace& a, const OuterFace& b) {
    return a.region < b.region;
  });
  return faces;
}

/// The nodes of the outer faces, numbered consecutively.
class OuterSurface {
 public:
  explicit OuterSurface(const fe_tire::Mesh& mesh) : mesh_(mesh) {
    std::map<int, std::uint32_t> number;
    std::map<std::pair<std::uint32_t, std::uint32_t>, bool> edges;
    for (const OuterFace& face : outer_faces(mesh)) {
      std::array<std::uint32_t, 4> at;
      for (std::size_t k = 0; k < 4; ++k) {
        const auto [place, fresh] =
            number.emplace(face.nodes[k], static_cast<std::uint32_t>(nodes_.size()));
        if (fresh) nodes_.push_back(face.nodes[k]);
        at[k] = place->second;
      }
      if (surface_.parts.empty() || region_ != face.region) begin_part(face.region);
      for (const int k : {0, 1, 2, 0, 2, 3})
        surface_.triangles.push_back(at[static_cast<std::size_t>(k)]);
      surface_.parts.back().count += 2;
      for (std::size_t k = 0; k < 4; ++k) {
        const auto a = at[k], b = at[(k + 1) % 4];
        edges[{std::min(a, b), std::max(a, b)}] = true;
      }
    }
    for (const auto& [edge, there] : edges)
      surface_.edges.insert(surface_.edges.end(), {edge.first, edge.second});
    surface_.name = "tire";
    surface_.points = points();
  }

  const Scene::Mesh& mesh() const { return surface_; }

  /// Returns a displacement field in the wheel frame. `u` is the field of the whole ring, or that
  /// of one sector, which is repeated.
  Eigen::Matrix3Xd field(const Eigen::Matrix3Xd& u) const {
    Eigen::Matrix3Xd values(3, nodes_.size());
    for (std::size_t k = 0; k < nodes_.size(); ++k)
      values.col(k) =
          mesh_.frame(nodes_[k] / mesh_.nodes_per_sector()) * u.col(nodes_[k] % u.cols());
    return values;
  }

 private:
  void begin_part(int region) {
    region_ = region;
    surface_.parts.push_back({mesh_.region_names.empty() ? "tire" : mesh_.region_names.at(region),
                              static_cast<std::uint32_t>(surface_.triangles.size() / 3),
                              0});
  }
  Eigen::Matrix3Xd points() const {
    Eigen::Matrix3Xd points(3, nodes_.size());
    for (std::size_t k = 0; k < nodes_.size(); ++k)
      points.col(k) = mesh_.frame(nodes_[k] / mesh_.nodes_per_sector()) *
                      mesh_.X.col(nodes_[k] % mesh_.nodes_per_sector());
    return points;
  }

  const fe_tire::Mesh& mesh_;
  std::vector<int> nodes_;
  Scene::Mesh surface_;
  int region_ = -1;
};

std::vector<float> lengths_in_mm(const Eigen::Matrix3Xd& vectors) {
  std::vector<float> lengths;
  for (Eigen::Index k = 0; k < vectors.cols(); ++k)
    lengths.push_back(static_cast<float>(1e3 * vectors.col(k).norm()));
  return lengths;
}

/// Returns a mesh that shows every contact point as a square of its area on the ground.
Scene::Mesh patch_of(const fe_tire::ContactPatch& patch, double ground) {
  Scene::Mesh mesh{"contact patch", Eigen::Matrix3Xd(3, 4 * patch.points.size()), {}, {}, {}};
  for (std::size_t i = 0; i < patch.points.size(); ++i) {
    const auto& p = patch.points[i];
    const double half = 0.5 * std::sqrt(p.area);
    const auto first = static_cast<Eigen::Index>(4 * i);
    mesh.points.col(first) << p.x - half, p.y - half, ground;
    mesh.points.col(first + 1) << p.x + half, p.y - half, ground;
    mesh.points.col(first + 2) << p.x + half, p.y + half, ground;
    mesh.points.col(first + 3) << p.x - half, p.y + half, ground;
    for (const int k : {0, 1, 2, 0, 2, 3})
      mesh.triangles.push_back(static_cast<std::uint32_t>(first + k));
  }
  mesh.parts = {{"contact", 0, static_cast<std::uint32_t>(mesh.triangles.size() / 3)}};
  return mesh;
}

/// Repeats the value of each contact point at the four corners of its square.
template <class Value>
std::vector<float> on_corners(const fe_tire::ContactPatch& patch, Value&& value) {
  std::vector<float> values;
  for (const auto& point : patch.points)
    values.insert(values.end(), 4, static_cast<float>(value(point)));
  return values;
}

void add_patch(const fe_tire::Standing& standing, Scene& scene) {
  if (standing.patch.points.empty()) return;
  const double ground = -standing.loaded_radius;
  scene.meshes.push_back(patch_of(standing.patch, ground));
  const Eigen::Matrix3Xd points = scene.meshes.back().points;
  scene.frames.push_back(
      {"contact pressure",
       "contact patch",
       points,
       "pressure",
       "kPa",
       on_corners(standing.patch, [](const auto& p) { return p.pressure / 1e3; }),
       {},
       0.0,
       ground});
  const auto shear = [](const auto& p) { return std::hypot(p.shear_x, p.shear_y); };
  const bool has_friction = std::any_of(standing.patch.points.begin(),
                                        standing.patch.points.end(),
                                        [&](const auto& p) { return shear(p) > 0.0; });
  if (!has_friction) return;
  scene.frames.push_back(
      {"shear over pressure",
       "contact patch",
       points,
       "shear over pressure",
       "1",
       on_corners(standing.patch,
                  [&](const auto& p) { return p.pressure > 0.0 ? shear(p) / p.pressure : 0.0; }),
       {},
       0.0,
       ground});
}

}  // namespace

Scene scene_of(const TirePictures& pictures) {
  const OuterSurface surface(pictures.mesh);
  Scene scene{{surface.mesh()}, {}};
  const Eigen::Matrix3Xd X = surface.mesh().points;
  scene.frames.push_back({"as built", "tire", X, "", ""});
  Eigen::Matrix3Xd inflated = Eigen::Matrix3Xd::Zero(3, X.cols()), loaded = inflated;
  if (pictures.inflated) {
    inflated = surface.field(pictures.inflated->u);
    scene.frames.push_back(
        {"inflated, " +
             std::to_string(static_cast<int>(std::lround(pictures.inflated->pressure / 1e3))) +
             " kPa",
         "tire",
         X + inflated,
         "displacement",
         "mm",
         lengths_in_mm(inflated)});
  }
  if (pictures.loaded) {
    loaded = surface.field(pictures.loaded->u);
    const auto& standing = pictures.loaded->standing;
    scene.frames.push_back(
        {"on the ground, " +
             std::to_string(static_cast<int>(std::lround(1e3 * standing.deflection))) + " mm",
         "tire",
         X + loaded,
         "displacement from inflated",
         "mm",
         lengths_in_mm(loaded - inflated),
         {},
         0.0,
         -standing.loaded_radius});
    add_patch(standing, scene);
  }
  const Eigen::Matrix3Xd base = X + (pictures.modes_loaded ? loaded : inflated);
  const double radius = X.colwise().norm().maxCoeff();
  for (std::size_t k = 0; k < std::min<std::size_t>(kMostModesShown, pictures.modes.size()); ++k) {
    const fe_tire::Mode& mode = pictures.modes[k];
    Eigen::Matrix3Xd shape = surface.field(mode.shape);
    const double largest = shape.colwise().norm().maxCoeff();
    if (largest > 0.0) shape *= kAmplitude * radius / largest;
    std::vector<float> share = lengths_in_mm(shape);
    const float most = *std::max_element(share.begin(), share.end());
    for (float& one : share) one /= most > 0.0F ? most : 1.0F;
    Scene::Frame frame{pictures.mode_name(k),
                       "tire",
                       base,
                       "amplitude, of the largest",
                       "1",
                       share,
                       shape,
                       mode.frequency,
                       {}};
    if (pictures.modes_loaded && pictures.loaded)
      frame.ground = -pictures.loaded->standing.loaded_radius;
    scene.frames.push_back(std::move(frame));
  }
  return scene;
}

}  // namespace latsch::report
