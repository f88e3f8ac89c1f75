// SPDX-License-Identifier: Apache-2.0
#include "harmonic_ring.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "models/fe_tire/analysis/ring_assembly.h"
#include "models/fe_tire/motion/tire_response.h"
#include "ring_mesh.h"
#include "spinning_rings.h"

namespace latsch::verification {
namespace {

using namespace latsch::fe_tire;

constexpr double kOuter = 0.30, kWidest = 0.01, kSame = 1e-9;  // m

/// Returns the outer nodes of a section plane, the one at y = 0.01 m first.
std::vector<int> outer_nodes(const Mesh& mesh, int plane) {
  std::vector<int> nodes;
  for (int k = 0; k < mesh.nodes_per_sector(); ++k) {
    if (std::abs(mesh.X(2, k) + kOuter) > kSame) continue;
    const bool is_listed = std::abs(mesh.X(1, k) - kWidest) < kSame;
    nodes.insert(is_listed ? nodes.begin() : nodes.end(), plane * mesh.nodes_per_sector() + k);
  }
  return nodes;
}

}  // namespace

const std::vector<HarmonicRow>& harmonic_rows() {
  static const std::vector<HarmonicRow> rows = {
      {20,
       {4.935478e-06, -7.593997e-08},
       {6.877834e-08, -2.034384e-09},
       {4.860768e-06, -7.499791e-08},
       {5.339274e-08, -1.839694e-09}},
      {30,
       {5.038180e-06, -1.191378e-07},
       {7.791368e-08, -3.714641e-09},
       {4.963479e-06, -1.177265e-07},
       {6.252337e-08, -3.422657e-09}},
      {40,
       {5.192682e-06, -1.698215e-07},
       {9.343648e-08, -6.575123e-09},
       {5.118215e-06, -1.679852e-07},
       {7.807621e-08, -6.194471e-09}},
      {50,
       {5.412991e-06, -2.332094e-07},
       {1.196638e-07, -1.203638e-08},
       {5.338663e-06, -2.309513e-07},
       {1.043395e-07, -1.157447e-08}},
      {60,
       {5.724181e-06, -3.191418e-07},
       {1.660606e-07, -2.383747e-08},
       {5.649862e-06, -3.164472e-07},
       {1.507655e-07, -2.330257e-08}},
      {80,
       {6.880511e-06, -6.995207e-07},
       {4.591982e-07, -1.537054e-07},
       {6.814010e-06, -7.017883e-07},
       {4.486633e-07, -1.575576e-07}},
      {100,
       {6.762298e-06, -4.962809e-06},
       {-1.509088e-06, -3.693332e-06},
       {6.690899e-06, -4.952807e-06},
       {-1.521264e-06, -3.686971e-06}},
      {120,
       {1.014935e-05, -4.992693e-06},
       {-2.958635e-06, 2.441756e-06},
       {1.006125e-05, -5.001545e-06},
       {-2.960309e-06, 2.453823e-06}},
      {150,
       {1.415432e-06, -7.148944e-06},
       {-4.315284e-06, -1.038075e-06},
       {1.346911e-06, -7.155622e-06},
       {-4.320805e-06, -1.041181e-06}},
      {200,
       {-1.827771e-06, -7.327945e-06},
       {1.270410e-06, -4.740686e-06},
       {-1.903175e-06, -7.318183e-06},
       {1.254486e-06, -4.738563e-06}},
  };
  return rows;
}

TireState harmonic_state(FeTire& ring) {
  TireState state = ring.over(*ring.inflate(0.0), {});
  state.pose.height *= 2.0;  // nothing touches
  return state;
}

std::vector<HarmonicRow> harmonic_response(bool has_static_shapes) {
  FeTire ring = gyro_ring(kHarmonicSectors);
  const Mesh& mesh = ring.mesh();
  std::vector<ResponsePort> ports;
  for (const int node : outer_nodes(mesh, 0)) ports.push_back({.node = node});
  const Eigen::Index loaded = std::ssize(ports);
  ports.push_back({.node = outer_nodes(mesh, kHarmonicSectors / 2).front()});
  const auto response = TireResponse::about(ring,
                                            {.owners = {}, .solids = {{}, {}}, .layers = {}},
                                            harmonic_state(ring),
                                            ports,
                                            {.highest = harmonic_rows().back().frequency,
                                             .rayleigh = kHarmonicDamping,
                                             .has_static_shapes = has_static_shapes});
  std::vector<HarmonicRow> rows;
  for (const HarmonicRow& listed : harmonic_rows()) {
    const Eigen::VectorXcd u =
        0.5 * response->at(listed.frequency).leftCols(loaded).rowwise().sum();
    rows.push_back({listed.frequency, u[0], u[loaded], {}, {}});
  }
  return rows;
}

HarmonicErrors harmonic_errors(const std::vector<HarmonicRow>& found) {
  HarmonicErrors errors;
  for (std::size_t k = 0; k < found.size(); ++k) {
    const HarmonicRow& listed = harmonic_rows()[k];
    errors.drive =
        std::max(errors.drive, std::abs(found[k].drive - listed.drive) / std::abs(listed.drive));
    errors.top = std::max(errors.top, std::abs(found[k].top - listed.top) / std::abs(listed.top));
  }
  return errors;
}

Eigen::MatrixXcd by_all_unknowns(double frequency,
                                 const std::vector<ResponsePort>& ports,
                                 const Rayleigh& damping) {
  const std::complex<double> s(0.0, 2.0 * std::numbers::pi * frequency);
  Mesh mesh = gyro_ring_mesh(kHarmonicSectors);
  const std::vector<int> rim = mesh.clamped;
  mesh.clamped.clear();
  const int n = mesh.nodes_per_sector();
  const Ring ring(mesh, ElementKind::full_integration);
  const RingElements elements(ring, gyro_ring_materials());
  const RingUnknowns unknowns(ring, RingSymmetry::none, {});
  const RingAssembly assembly(unknowns);
  AssembledState state = assembly.zero_state();
  numerics::SymmetricMatrix K(*assembly.pattern());
  Eigen::VectorXd f;
  int worst = 0;
  assembly.assemble(elements, state, 0.0, f, &K, &worst);
  const numerics::SymmetricMatrix M = assembly.mass(elements);
  const int size = unknowns.size();
  const Eigen::MatrixXd unit = Eigen::MatrixXd::Identity(size, size);
  Eigen::MatrixXd product(size, size);
  K.multiply(unit, product);
  Eigen::MatrixXcd Z = (1.0 + s * damping.b) * product;
  M.multiply(unit, product);
  Z += (s * damping.a + s * s) * product;
  // Unknowns of the rim and the others.
  std::vector<int> held, free;
  std::vector<Eigen::Vector3d> places(size / 3);
  for (int plane = 0; plane < mesh.sectors; ++plane) {
    for (int k = 0; k < n; ++k) {
      const int first = unknowns.of_node(plane, k).first;
      places[first / 3] = mesh.X.col(k);
      const bool is_held = std::ranges::find(rim, k) != rim.end();
      for (int d = 0; d < 3; ++d) (is_held ? held : free).push_back(first + d);
    }
  }
  // Displacements of all nodes for a unit of each port: a rigid motion, or none. Frames of the
  // sectors turn with the planes.
  const auto count = std::ssize(ports);
  Eigen::MatrixXcd moved = Eigen::MatrixXcd::Zero(size, count), loads = moved;
  for (Eigen::Index i = 0; i < count; ++i) {
    const ResponsePort& port = ports[i];
    for (int plane = 0; plane < mesh.sectors; ++plane) {
      const Eigen::Matrix3d in_sector = mesh.frame(plane).transpose();
      for (int k = 0; k < n; ++k) {
        const int first = unknowns.of_node(plane, k).first;
        const Eigen::Vector3d axis = in_sector * port.axis;
        if (port.of == ResponsePort::Of::wheel)
          moved.col(i).segment<3>(first) =
              port.turns ? Eigen::Vector3d(axis.cross(mesh.X.col(k))) : axis;
        else if (port.node == plane * n + k)
          loads.col(i).segment<3>(first) = axis;
      }
    }
  }
  const Eigen::MatrixXcd moved_rim = moved(held, Eigen::all), Z_free = Z(free, free);
  const Eigen::MatrixXcd on_free = loads(free, Eigen::all) - Z(free, held) * moved_rim;
  const Eigen::MatrixXcd answer = Z_free.partialPivLu().solve(on_free);
  Eigen::MatrixXcd u = Eigen::MatrixXcd::Zero(size, count);
  u(held, Eigen::all) = moved_rim;
  u(free, Eigen::all) = answer;
  const Eigen::MatrixXcd Z_held = Z(held, Eigen::all), reactions = Z_held * u;
  Eigen::MatrixXcd H(count, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    if (ports[i].of == ResponsePort::Of::point)
      H.row(i) = loads.col(i).transpose() * u;
    else
      H.row(i) = -moved_rim.col(i).transpose() * reactions;
  }
  return H;
}

double reaction_error() {
  FeTire ring = gyro_ring(kHarmonicSectors);
  const int n = ring.mesh().nodes_per_sector();
  std::vector<ResponsePort> ports;
  for (const int node : {n - 1, 7 * n - 2})
    for (int d = 0; d < 3; ++d) ports.push_back({.node = node, .axis = Eigen::Vector3d::Unit(d)});
  for (const bool turns : {false, true})
    for (int d = 0; d < 3; ++d)
      ports.push_back(
          {.of = ResponsePort::Of::wheel, .axis = Eigen::Vector3d::Unit(d), .turns = turns});
  const Rayleigh damping{0.0, 1e-4};  // a mass that is damped would brake a rim that moves
  const auto response = TireResponse::about(ring,
                                            {.owners = {}, .solids = {{}, {}}, .layers = {}},
                                            harmonic_state(ring),
                                            ports,
                                            {.highest = 200.0, .rayleigh = damping});
  constexpr double kSmall = 0.05;
  double error = 0.0;
  for (const double frequency : {5.0, 60.0, 110.0, 190.0}) {
    const Eigen::MatrixXcd modal = response->at(frequency),
                           all = by_all_unknowns(frequency, ports, damping);
    for (Eigen::Index i = 0; i < all.rows(); ++i) {
      for (Eigen::Index j = 0; j < all.cols(); ++j) {
        const double size =
            std::max(std::abs(all(i, j)), kSmall * std::sqrt(std::abs(all(i, i) * all(j, j))));
        error = std::max(error, std::abs(modal(i, j) - all(i, j)) / size);
      }
    }
  }
  return error;
}

}  // namespace latsch::verification
