// SPDX-License-Identifier: Apache-2.0
// The finite-element tire: inflate it, press it on the ground, compute its modes.
//
//   FeTire tire(mesh, materials);
//   auto inflated = tire.inflate(2.6e5);
//   auto loaded   = tire.load(*inflated, {0.005, 0.010, 0.025}, ground);
//   auto modes    = tire.modes(*loaded, 20);
//
// The symbolic work (sparsity, ordering) depends on the mesh alone and is done once, when first
// more than a sector is needed; set() changes only the values.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "models/fe_tire/element/hex8.h"
#include "models/fe_tire/element/materials.h"
#include "models/fe_tire/element/mesh.h"

namespace latsch::fe_tire {

/// Rigid flat ground, normal +z, penalty contact and Coulomb friction.
struct Ground {
  double stiffness = 2.0e10;  // normal penalty, Pa/m
  double mu = 0.0;            // friction coefficient; 0: frictionless
};

/// Equilibrium of the inflated tire; the same in every sector. Rim clamped.
struct Inflated {
  double pressure = 0.0;  // Pa
  Eigen::Matrix3Xd u;     // [3 x nodes_per_sector], sector frame, m  (S = 1: the whole mesh)
  Eigen::VectorXd alpha;  // internal parameters of one sector's elements
  double growth = 0.0;    // m, radial displacement of the outermost tread node
  double radius = 0.0;    // m, distance of the lowest tread point from the wheel center
};

/// Where tire and ground touch.
struct ContactPatch {
  double length = 0.0, width = 0.0;  // m, extent along x and y
  double area = 0.0;                 // m^2
  struct Point {
    double x, y;              // m, wheel frame
    double pressure;          // Pa
    double shear_x, shear_y;  // Pa, on the tire
    double area;              // m^2 of this integration point
    bool sticks;
  };
  std::vector<Point> points;
};

/// Equilibrium at one deflection.
struct LoadPoint {
  double deflection = 0.0;     // m, from first touch of the inflated tire
  double loaded_radius = 0.0;  // m, wheel center to ground
  double Fz = 0.0;             // N, on the tire, upward
  ContactPatch patch;
};

struct Loaded {
  Inflated inflated;
  Ground ground;
  std::vector<LoadPoint> curve;  // one a requested deflection, in the order solved
  Eigen::Matrix3Xd u;            // [3 x nodes], sector frames, m, at the last deflection
  Eigen::VectorXd alpha;  // internal parameters there, of the elements solved for (half the ring
                          // where it is symmetric): part of the state, found only from near it
};

enum class ModeType { torsional, lateral, radial, other };
std::string name(ModeType type);  // "torsional"
std::optional<ModeType> mode_type(const std::string& name);

struct Mode {
  double frequency = 0.0;  // Hz
  int n = 0;               // dominating circumferential number
  ModeType type = ModeType::other;
  int order = 1;     // 1, 2, ... among modes of the same n and type, by frequency
  char phase = ' ';  // of a split pair in the loaded state: 's' symmetric, 'a' antisymmetric in x;
                     // ' ' unloaded
  Eigen::Matrix3Xd
      shape;  // [3 x nodes], sector frames, mass-normalized; unloaded pairs: two orthogonal members
  std::string label() const;  // "lateral n=1", "radial n=2 a", "radial n=3 (2)"
};

struct SolverSettings {
  ElementKind element = ElementKind::solid_shell;
  double tolerance = 1e-5;  // residual norm relative to the norm of the pressure load
  int max_iterations = 40;  // Newton iterations a load step
};

/// What a trial cost: for benchmarks and for the report.
struct SolverCounts {
  int analyses = 0;  // symbolic ones, of the ring
  int assemblies = 0, factorizations = 0, cg_iterations = 0, solves = 0, shifts = 0;
};

struct TireDescription;

class FeTire {
 public:
  FeTire(Mesh mesh, Materials materials, SolverSettings settings = {});
  /// With the mesh, the materials and the elements of the description.
  explicit FeTire(const TireDescription& description);
  ~FeTire();
  FeTire(FeTire&&) noexcept;
  FeTire& operator=(FeTire&&) noexcept;

  const Mesh& mesh() const;
  const Materials& materials() const;
  /// New material values on the same mesh.
  void set(Materials materials);

  Result<Inflated> inflate(double pressure);
  /// Presses the tire on the ground, in the order given; every deflection is an equilibrium (m,
  /// from first touch). A Failure where there is none, and where the last one is not stable.
  Result<Loaded> load(const Inflated& inflated,
                      const std::vector<double>& deflections,
                      const Ground& ground);

  /// The lowest `count` modes of the inflated, unloaded tire by circumferential harmonics.
  Result<std::vector<Mode>> modes(const Inflated& inflated, int count);
  /// The same by a full eigen-solve over the whole ring, for comparison.
  Result<std::vector<Mode>> modes_full(const Inflated& inflated, int count);
  /// Modes of the loaded state; points in contact stay in contact, with friction they stick.
  Result<std::vector<Mode>> modes(const Loaded& loaded, int count);

  double total_mass() const;  // kg
  SolverCounts counts() const;
  void reset_counts();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace latsch::fe_tire
