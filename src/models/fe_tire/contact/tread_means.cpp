// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/contact/tread_means.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace latsch::fe_tire {
namespace {

/// Returns the factor of (T.3) on the area of an averaged point. Of the points around a node, only
/// the one at the node itself compensates the area that the node lacks.
template <class ShareAt>
double share_of(int place, ShareAt share_at) {
  return place % kPlaces == 0 ? 1.0 + kPlaces * (share_at(place / kPlaces) - 1.0) : 1.0;
}

}  // namespace

std::vector<TreadStrip> tread_strips(const Mesh& mesh) {
  const int n = mesh.nodes_per_sector();
  if (mesh.sectors == 1) return {};
  std::map<int, int> next;  // next node across the tread, by node
  std::map<int, int> before;
  for (const Element& element : mesh.elements) {
    if (!element.tread) continue;
    const auto& node = element.node;
    if (node[5] != node[4] + n || node[6] != node[7] + n || node[4] >= n || node[7] >= n) return {};
    if (!next.emplace(node[4], node[7]).second || !before.emplace(node[7], node[4]).second)
      return {};
  }
  std::vector<TreadStrip> strips;
  for (const auto& [first, second] : next) {
    if (before.contains(first)) continue;
    TreadStrip& strip = strips.emplace_back();
    strip.nodes.push_back(first);
    for (auto at = next.find(first); at != next.end(); at = next.find(at->second)) {
      strip.nodes.push_back(at->second);
      strip.span.push_back((mesh.X.col(at->second) - mesh.X.col(at->first)).norm());
    }
  }
  return strips;
}

double angle_of_plane(const Mesh& mesh, int plane) {
  const int turns = static_cast<int>(std::floor(static_cast<double>(plane) / mesh.sectors));
  return mesh.angle(plane - turns * mesh.sectors) + 2.0 * std::numbers::pi * turns;
}

MeanAround mean_around(const Mesh& mesh, int place) {
  const auto angle = [&mesh](int plane) { return angle_of_plane(mesh, plane); };
  const auto width = [&angle](int sector) { return angle(sector + 1) - angle(sector); };
  const auto cubic = [&](int s, double u) {
    return hermite(width(s - 1), width(s), width(s + 1), u);
  };
  const int sector = face_of(place);
  MeanAround around;
  around.place = place;
  around.theta = angle(sector) + 0.5 * (1.0 + within_face(place)) * width(sector);
  around.mean = hat_mean(
      place, std::nullopt, cubic, [&](int s, double, const Cubic&) { return 0.5 * width(s); });
  around.moment = hat_mean(place, std::nullopt, cubic, [&](int s, double t, const Cubic&) {
                    const double from = angle(s) + t * width(s) - around.theta;
                    return 0.5 * width(s) * from * from;
                  }).size;
  around.share = share_of(place, [&](int s) {
    return share_of_uniform({width(s - 2), width(s - 1), width(s), width(s + 1)});
  });
  return around;
}

std::vector<MeanAcross> means_across(const Mesh& mesh, const TreadStrip& strip) {
  const int faces = static_cast<int>(strip.span.size());
  const auto cubic = [&](int face, double v) {
    return hermite(strip.span_at(face - 1), strip.span[face], strip.span_at(face + 1), v);
  };
  const auto sum = [&](int face, const Eigen::Vector4d& weights) {
    Eigen::Vector3d x = Eigen::Vector3d::Zero();
    for (int k = 0; k < 4; ++k) {
      const int node = face - 1 + k;
      if (node >= 0 && node <= faces) x += weights[k] * mesh.X.col(strip.nodes[node]);
    }
    return x;
  };
  std::vector<MeanAcross> means;
  for (int place = 0; place <= kPlaces * faces; ++place) {
    const int face = std::min(face_of(place), faces - 1);
    const Cubic there = cubic(face, 2.0 * (place - kPlaces * face) / kPlaces - 1.0);
    MeanAcross& across = means.emplace_back();
    across.mean = hat_mean(place, faces, cubic, [&](int f, double, const Cubic& at) {
      return -sum(f, at.value).z() * sum(f, at.slope).norm();
    });
    across.share = share_of(place, [&](int n) {
      return share_of_uniform(
          {strip.span_at(n - 2), strip.span_at(n - 1), strip.span_at(n), strip.span_at(n + 1)});
    });
    across.X = sum(face, there.value);
    across.slope = sum(face, there.slope);
  }
  return means;
}

}  // namespace latsch::fe_tire
