// SPDX-License-Identifier: Apache-2.0
// The finite-element tire: inflate it, stand it on the ground, move the ground, compute its modes.
//
//   FeTire tire(mesh, materials);
//   auto inflated = tire.inflate(2.6e5);
//   auto states   = tire.press(*inflated, ground, {0.005, 0.010, 0.025});
//   double Fz     = tire.stand(states->back()).force.z();
//   auto modes    = tire.modes(states->back(), 20);
//
// A state is a value: copied, kept, gone on from as often as wanted. What follows from one depends
// on it and the poses alone. The symbolic work (sparsity, ordering) depends on the mesh alone and
// is done once, when first more than a sector is needed; set() changes only the values.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "models/fe_tire/analysis/mass_properties.h"
#include "models/fe_tire/analysis/solver_settings.h"
#include "models/fe_tire/contact/contact.h"
#include "models/fe_tire/contact/ground.h"
#include "models/fe_tire/element/hex8.h"
#include "models/fe_tire/element/materials.h"
#include "models/fe_tire/element/mesh.h"

namespace latsch::fe_tire {

/// Equilibrium of the inflated tire; the same in every sector. Rim clamped.
struct Inflated {
  double pressure = 0.0;  // Pa
  Eigen::Matrix3Xd u;     // [3 x nodes_per_sector], sector frame, m  (S = 1: the whole mesh)
  Eigen::VectorXd alpha;  // internal parameters of one sector's elements
  double growth = 0.0;    // m, radial displacement of the tread node nearest to the middle plane
  double radius = 0.0;    // m, distance of the lowest tread point from the wheel center
  double width = 0.0;     // m, of the section, from sidewall to sidewall
};

/// Equilibrium on the ground, or over it. Rim clamped.
struct TireState {
  std::shared_ptr<const Inflated> inflated;  // what it was before it touched
  Ground ground;
  GroundPose pose;
  /// Whether poses stay below the wheel center (GroundPose::is_below) and half the ring stands for
  /// all of it.
  bool is_halved = false;
  int window = 0;         // how far up the tread may touch: TreadSurface's half angle grows with it
  Eigen::Matrix3Xd u;     // [3 x nodes], sector frames, m
  Eigen::VectorXd alpha;  // internal parameters there, of the elements solved for: part of the
                          // state, found only from near it
  std::vector<Anchor> anchors;  // of friction; none without

  /// m, from first touch of the inflated tire on flat ground.
  double deflection() const { return inflated->radius - pose.height; }
};

/// What a rig sees of a state.
struct Standing {
  double deflection = 0.0;     // m, from first touch of the inflated tire
  double loaded_radius = 0.0;  // m, wheel center to ground
  // Of the ground on the tire, in axes that stand on the ground and head as the wheel does.
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   // N
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();  // N m, about the wheel center
  ContactPatch patch;
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
  /// The same, searched near displacements known of another mesh (section_grid.h).
  Result<Inflated> inflate(double pressure, const Eigen::Matrix3Xd& near);

  /// The inflated tire over this ground, just touching it. `poses`: whether the ground will stay
  /// below the wheel center; then half the ring stands for all of it where its symmetry allows.
  enum class Poses { below, any };
  TireState over(const Inflated& inflated, const Ground& ground, Poses poses = Poses::below);
  /// Where the ground is at a deflection, m, from first touch of the inflated tire.
  static GroundPose below(const Inflated& inflated, double deflection) {
    return {.height = inflated.radius - deflection};
  }
  /// Moves the ground from pose to pose and finds the equilibrium in each of them. With friction
  /// the way is part of the answer. Failure names pose, residual and worst element; it is one too
  /// where the last equilibrium is not stable.
  Result<std::vector<TireState>> advance(const TireState& from,
                                         const std::vector<GroundPose>& poses);
  /// The same straight down, to these deflections (m, from first touch) one after the other.
  Result<std::vector<TireState>> press(const Inflated& inflated,
                                       const Ground& ground,
                                       const std::vector<double>& deflections);
  Standing stand(const TireState& state);
  /// The points that touch in a state. Held (Ground::held) they are its branch: another tire of the
  /// same mesh but for where its nodes are, or the same elsewhere, stands on it too.
  TouchingPoints touching(const TireState& state);

  /// The lowest `count` modes of the inflated, unloaded tire by circumferential harmonics.
  Result<std::vector<Mode>> modes(const Inflated& inflated, int count);
  /// The same by a full eigen-solve over the whole ring, for comparison.
  Result<std::vector<Mode>> modes_full(const Inflated& inflated, int count);
  /// Modes about the state; points in contact stay in contact, with friction they stick.
  Result<std::vector<Mode>> modes(const TireState& state, int count);

  double total_mass() const;  // kg
  MassProperties mass_properties(const Inflated& inflated) const;
  SolverCounts counts() const;
  void reset_counts();

 private:
  friend class TireSlopes;
  friend struct Varied;
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace latsch::fe_tire
