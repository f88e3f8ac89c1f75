// SPDX-License-Identifier: Apache-2.0
#include "optimization/region/tangent_cone.h"

#include <Eigen/LU>
#include <algorithm>

#include "numerics/dense/orthogonal_factors.h"

namespace latsch {
namespace {

// Product of two unit vectors below which they count as orthogonal, so that a direction lies in a
// plane.
constexpr double kZero = 1e-9;
constexpr int kMostRays = 2000;

struct Basis {
  Eigen::MatrixXd range, rest;   // orthonormal columns
  std::vector<int> independent;  // indices of independent columns that span the range
};

Basis split(const Eigen::MatrixXd& M) {
  const auto n = M.rows();
  if (M.cols() == 0) return {Eigen::MatrixXd(n, 0), Eigen::MatrixXd::Identity(n, n), {}};
  const auto [Q, order, rank] = numerics::pivoted_qr(M, kZero);
  return {Q.leftCols(rank), Q.rightCols(n - rank), {order.begin(), order.begin() + rank}};
}

/// A ray and the planes that contain it.
struct Ray {
  Eigen::VectorXd d;
  std::vector<int> planes;  // ascending
};

/// The rays of the cone { d : c_j'd <= 0 }, computed by adding one plane after the other.
class DoubleDescription {
 public:
  /// Starts from as many independent planes as there are dimensions. Ray k lies in all of these
  /// planes except plane k.
  DoubleDescription(const Eigen::MatrixXd& C, const std::vector<int>& independent) : C_(C) {
    Eigen::MatrixXd first(C.rows(), C.rows());
    for (size_t k = 0; k < independent.size(); ++k) first.col(k) = C.col(independent[k]);
    const Eigen::MatrixXd inverse = first.inverse();
    for (size_t k = 0; k < independent.size(); ++k) {
      Ray ray{-inverse.row(k).transpose().normalized(), independent};
      ray.planes.erase(ray.planes.begin() + static_cast<long>(k));
      std::sort(ray.planes.begin(), ray.planes.end());
      rays_.push_back(std::move(ray));
    }
  }

  void take_in(int plane) {
    std::vector<Ray> kept;
    std::vector<const Ray*> inside, outside;
    for (Ray& ray : rays_) {
      const double side = C_.col(plane).dot(ray.d);
      if (side > kZero) {
        outside.push_back(&ray);
      } else if (side < -kZero) {
        inside.push_back(&ray);
      } else {
        ray.planes.insert(std::lower_bound(ray.planes.begin(), ray.planes.end(), plane), plane);
      }
      if (side <= kZero) kept.push_back(ray);
    }
    for (const Ray* out : outside) {
      for (const Ray* in : inside) {
        if (auto ray = between(*in, *out, plane); !ray.planes.empty()) kept.push_back(ray);
      }
    }
    rays_ = std::move(kept);
  }

  const std::vector<Ray>& rays() const { return rays_; }

 private:
  /// Returns the ray in which `plane` intersects the face spanned by two neighboring rays. If the
  /// two rays are not neighbors, the result has no planes.
  Ray between(const Ray& in, const Ray& out, int plane) const {
    std::vector<int> common;
    std::set_intersection(in.planes.begin(),
                          in.planes.end(),
                          out.planes.begin(),
                          out.planes.end(),
                          std::back_inserter(common));
    const auto holds_them = [&](const Ray& ray) {
      return &ray != &in && &ray != &out &&
             std::includes(ray.planes.begin(), ray.planes.end(), common.begin(), common.end());
    };
    if (std::any_of(rays_.begin(), rays_.end(), holds_them)) return {};
    const auto c = C_.col(plane);
    Ray ray{(c.dot(out.d) * in.d - c.dot(in.d) * out.d).normalized(), common};
    ray.planes.insert(
        std::lower_bound(common.begin(), common.end(), plane) - common.begin() + ray.planes.begin(),
        plane);
    return ray;
  }

  const Eigen::MatrixXd& C_;
  std::vector<Ray> rays_;
};

}  // namespace

ConeGenerators tangent_cone(const Eigen::MatrixXd& V, const Eigen::MatrixXd& E) {
  const Eigen::MatrixXd S = split(E).rest;  // d = S y fulfills the equations for every y
  Eigen::MatrixXd M(S.cols(), 0);
  for (Eigen::Index j = 0; j < V.cols(); ++j) {
    const Eigen::VectorXd along = S.transpose() * V.col(j);
    if (along.norm() <= kZero) continue;  // the constraint follows from the equations
    M.conservativeResize(Eigen::NoChange, M.cols() + 1);
    M.col(M.cols() - 1) = along.normalized();
  }
  const Basis basis = split(M);
  ConeGenerators cone{S * basis.rest, {}};
  if (basis.independent.empty()) return cone;

  const Eigen::MatrixXd C = basis.range.transpose() * M;
  DoubleDescription description(C, basis.independent);
  for (int j = 0; j < C.cols(); ++j) {
    const auto& done = basis.independent;
    if (std::find(done.begin(), done.end(), j) != done.end()) continue;
    if (std::ssize(description.rays()) > kMostRays) break;
    description.take_in(j);
  }
  for (const Ray& ray : description.rays()) cone.rays.push_back(S * (basis.range * ray.d));
  return cone;
}

}  // namespace latsch
