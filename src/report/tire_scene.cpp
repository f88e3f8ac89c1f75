// SPDX-License-Identifier: Apache-2.0
#include "report/tire_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <string_view>

namespace latsch::report {
namespace {

constexpr int kMostModes = 12;
constexpr double kModeAmplitude = 0.09;  // of the outer radius

constexpr std::array<std::array<int, 4>, 6> kFaces = {
    {{0, 1, 2, 3}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};

/// Least significant byte first, as every browser has it.
template <class Integer>
std::string packed(const std::vector<Integer>& numbers) {
  std::string bytes;
  for (Integer number : numbers) {
    for (size_t k = 0; k < sizeof number; ++k) bytes += static_cast<char>(number >> (8 * k) & 0xff);
  }
  return base64(bytes);
}

/// Faces that belong to one element only, as nodes of the whole ring.
std::vector<std::array<int, 4>> surface_faces(const fe_tire::Mesh& mesh) {
  std::map<std::array<int, 4>, std::pair<int, std::array<int, 4>>> seen;
  for (int s = 0; s < mesh.sectors; ++s) {
    for (const fe_tire::Element& element : mesh.elements) {
      for (const auto& face : kFaces) {
        std::array<int, 4> nodes;
        for (int k = 0; k < 4; ++k) {
          nodes[k] = (s * mesh.nodes_per_sector() + element.node[face[k]]) % mesh.nodes();
        }
        std::array<int, 4> key = nodes;
        std::sort(key.begin(), key.end());
        auto& [count, first] = seen[key];
        ++count;
        first = nodes;
      }
    }
  }
  std::vector<std::array<int, 4>> faces;
  for (const auto& [key, face] : seen) {
    if (face.first == 1) faces.push_back(face.second);
  }
  return faces;
}

class PackedSurface {
 public:
  explicit PackedSurface(const fe_tire::Mesh& mesh) : mesh_(mesh) {
    std::map<int, int> number;
    for (const auto& face : surface_faces(mesh)) {
      for (int node : face) {
        const auto [at, fresh] = number.emplace(node, static_cast<int>(nodes_.size()));
        if (fresh) nodes_.push_back(node);
        faces_.push_back(static_cast<std::uint16_t>(at->second));
      }
    }
  }

  bool fits() const { return nodes_.size() < 65536; }
  std::string faces() const { return packed(faces_); }

  /// Positions of the surface nodes in the wheel frame.
  Eigen::Matrix3Xd points() const {
    Eigen::Matrix3Xd points(3, nodes_.size());
    for (size_t k = 0; k < nodes_.size(); ++k) {
      const int sector = nodes_[k] / mesh_.nodes_per_sector();
      points.col(k) = mesh_.frame(sector) * mesh_.X.col(nodes_[k] % mesh_.nodes_per_sector());
    }
    return points;
  }

  /// A displacement field of the ring, or of one sector repeated, at the surface nodes in the wheel
  /// frame.
  Eigen::Matrix3Xd field(const Eigen::Matrix3Xd& u) const {
    Eigen::Matrix3Xd values(3, nodes_.size());
    for (size_t k = 0; k < nodes_.size(); ++k) {
      const int sector = nodes_[k] / mesh_.nodes_per_sector();
      values.col(k) = mesh_.frame(sector) * u.col(nodes_[k] % u.cols());
    }
    return values;
  }

 private:
  const fe_tire::Mesh& mesh_;
  std::vector<int> nodes_;
  std::vector<std::uint16_t> faces_;
};

/// {"scale": ..., "data": "..."}
template <class Integer>
std::string numbers(const Eigen::Ref<const Eigen::MatrixXd>& values) {
  const double largest = values.size() ? values.cwiseAbs().maxCoeff() : 0.0;
  const double scale = largest > 0.0 ? largest / std::numeric_limits<Integer>::max() : 1.0;
  std::vector<Integer> integers;
  for (double v : values.reshaped())
    integers.push_back(static_cast<Integer>(std::lround(v / scale)));
  return fmt::format("{{\"scale\":{:.6g},\"data\":\"{}\"}}", scale, packed(integers));
}

}  // namespace

std::string base64(std::string_view bytes) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (size_t k = 0; k < bytes.size(); k += 3) {
    std::uint32_t three = 0;
    for (size_t b = 0; b < 3; ++b) {
      three = three << 8 | (k + b < bytes.size() ? static_cast<unsigned char>(bytes[k + b]) : 0u);
    }
    for (int digit = 0; digit < 4; ++digit) text += kDigits[three >> (18 - 6 * digit) & 63];
  }
  const size_t missing = (3 - bytes.size() % 3) % 3;
  text.replace(text.size() - missing, missing, missing, '=');
  return text;
}

int shown_modes(const TirePictures& pictures) {
  return std::min(kMostModes, static_cast<int>(pictures.modes.size()));
}

std::string scene_json(const TirePictures& pictures) {
  const PackedSurface scene(pictures.mesh);
  if (!scene.fits()) return "";
  const Eigen::Matrix3Xd X = scene.points();
  Eigen::Matrix3Xd inflated = Eigen::Matrix3Xd::Zero(3, X.cols()), loaded = inflated;
  if (pictures.inflated) inflated = scene.field(pictures.inflated->u);
  std::string states;
  if (pictures.loaded) {
    loaded = scene.field(pictures.loaded->u);
    const Eigen::MatrixXd moved = (loaded - inflated).colwise().norm();
    const double ground = pictures.loaded->standing.loaded_radius;
    states += fmt::format("{{\"kind\":\"loaded\",\"ground\":{:.6g},\"base\":{},\"color\":{}}}",
                          ground,
                          numbers<std::int16_t>(X + loaded),
                          numbers<std::int16_t>(moved));
  }
  const Eigen::Matrix3Xd base = X + (pictures.modes_loaded ? loaded : inflated);
  const double radius = X.colwise().norm().maxCoeff();
  std::string modes;
  for (int k = 0; k < shown_modes(pictures); ++k) {
    Eigen::Matrix3Xd shape = scene.field(pictures.modes[k].shape);
    const double largest = std::sqrt(shape.colwise().squaredNorm().maxCoeff());
    if (largest > 0.0) shape *= kModeAmplitude * radius / largest;
    if (k > 0) modes += ",";
    modes += numbers<std::int8_t>(shape);
  }
  return fmt::format(
      "{{\"faces\":\"{}\",\"radius\":{:.6g},\"base\":{},\"states\":[{}],\"modes\":[{}]}}",
      scene.faces(),
      radius,
      numbers<std::int16_t>(base),
      states,
      modes);
}

}  // namespace latsch::report
