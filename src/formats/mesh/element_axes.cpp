// SPDX-License-Identifier: Apache-2.0
#include "formats/mesh/element_axes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <deque>
#include <map>
#include <optional>

namespace latsch::formats {
namespace {

class Aligner {
 public:
  Aligner(const Eigen::Matrix3Xd& X, const std::vector<HexNodes>& elements)
      : X_(X), elements_(elements), zeta_(elements.size()) {
    for (int e = 0; e < static_cast<int>(elements.size()); ++e)
      for (int axis = 0; axis < 3; ++axis)
        for (int sign : {-1, 1}) faces_[face_key(e, {axis, sign})].push_back({e, {axis, sign}});
  }

  void spread(const std::vector<KnownFace>& known) {
    for (const KnownFace& face : known) {
      if (faces_.at(face_key(face.element, face.outward)).size() > 1) buried_ = face.element;
      reach(face.element, face.inner ? -face.outward : face.outward);
    }
    while (!stacks_.empty() || !sideways_.empty()) {
      if (!stacks_.empty()) {
        const int e = stacks_.front();
        stacks_.pop_front();
        for (const LocalDirection d : {*zeta_[e], -*zeta_[e]}) spread_through(e, d);
        sideways_.push_back(e);
      } else {
        const int e = sideways_.front();
        sideways_.pop_front();
        spread_sideways(e);
      }
    }
  }

  std::optional<LocalDirection> zeta(int e) const { return zeta_[e]; }
  int buried() const { return buried_; }

  /// Returns the local direction of element e that is nearest to the circumferential direction.
  LocalDirection xi(int e) const {
    const Hex x = coordinates(e);
    const Eigen::Vector3d middle = x.rowwise().mean();
    const Eigen::Vector3d forward = Eigen::Vector3d(-middle.z(), 0.0, middle.x()).normalized();
    LocalDirection best;
    double most = -1.0;
    for (int axis = 0; axis < 3; ++axis) {
      if (axis == zeta_[e]->axis) continue;
      const double along = span(x, {axis, 1}).normalized().dot(forward);
      if (std::abs(along) > most) {
        most = std::abs(along);
        best = {axis, along > 0.0 ? 1 : -1};
      }
    }
    return best;
  }

 private:
  struct Face {
    int element;
    LocalDirection outward;
  };
  using Key = std::array<int, 4>;

  Key face_key(int e, LocalDirection outward) const {
    Key key{};
    const auto corners = face_corners(outward);
    for (int i = 0; i < 4; ++i) key[i] = elements_[e][corners[i]];
    std::sort(key.begin(), key.end());
    return key;
  }

  Hex coordinates(int e) const {
    Hex x;
    for (int a = 0; a < 8; ++a) x.col(a) = X_.col(elements_[e][a]);
    return x;
  }

  void reach(int e, LocalDirection zeta) {
    if (zeta_[e]) return;
    zeta_[e] = zeta;
    stacks_.push_back(e);
  }

  /// Continues from an element to its neighbor in the direction `outward`, if that direction is
  /// along the local axis zeta.
  void spread_through(int e, LocalDirection outward) {
    for (const Face& other : faces_.at(face_key(e, outward)))
      if (other.element != e)
        reach(other.element, outward == *zeta_[e] ? -other.outward : other.outward);
  }

  void spread_sideways(int e) {
    const Eigen::Vector3d along = span(coordinates(e), *zeta_[e]);
    for (int axis = 0; axis < 3; ++axis)
      for (int sign : {-1, 1}) {
        if (axis == zeta_[e]->axis) continue;
        for (const Face& other : faces_.at(face_key(e, {axis, sign})))
          if (!zeta_[other.element]) reach(other.element, nearest(other, along));
      }
  }

  /// Returns the local direction of an element that is nearest to the vector `along`, other than
  /// the axis through the shared face.
  LocalDirection nearest(const Face& shared, const Eigen::Vector3d& along) const {
    const Hex x = coordinates(shared.element);
    LocalDirection best;
    double most = -1.0;
    for (int axis = 0; axis < 3; ++axis) {
      if (axis == shared.outward.axis) continue;
      const double cosine = span(x, {axis, 1}).normalized().dot(along.normalized());
      if (std::abs(cosine) > most) {
        most = std::abs(cosine);
        best = {axis, cosine > 0.0 ? 1 : -1};
      }
    }
    return best;
  }

  const Eigen::Matrix3Xd& X_;
  const std::vector<HexNodes>& elements_;
  std::vector<std::optional<LocalDirection>> zeta_;
  std::map<Key, std::vector<Face>> faces_;
  std::deque<int> stacks_, sideways_;
  int buried_ = -1;
};

}  // namespace

Alignment align_elements(const Eigen::Matrix3Xd& X,
                         std::vector<HexNodes>& elements,
                         const std::vector<KnownFace>& known) {
  std::vector<HexNodes> aligned = elements;
  Alignment alignment{std::vector<char>(elements.size(), 0), -1};
  Aligner aligner(X, elements);
  aligner.spread(known);
  for (int e = 0; e < static_cast<int>(elements.size()); ++e) {
    if (!aligner.zeta(e)) continue;
    alignment.reached[e] = 1;
    const auto present = renumbering(aligner.xi(e), *aligner.zeta(e));
    for (int a = 0; a < 8; ++a) aligned[e][a] = elements[e][present[a]];
  }
  elements = std::move(aligned);
  alignment.buried = aligner.buried();
  return alignment;
}

}  // namespace latsch::formats
