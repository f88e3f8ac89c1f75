// SPDX-License-Identifier: Apache-2.0
// The finite-element tire: inflate it, stand it on the ground, move the ground, compute its modes.
//
//   FeTire tire(mesh, materials);
//   auto inflated = tire.inflate(2.6e5);
//   auto states   = tire.press(*inflated, ground, {0.005, 0.010, 0.025});
//   double Fz     = tire.stand(states->back()).force.z();
//   auto modes    = tire.modes(states->back(), 20);
//
// A state is a value: it can be copied and stored, and several computations can start from it.
// Their results depend only on the state and the poses of the ground. The symbolic work (sparsity,
// ordering) depends on the mesh alone and is done once, when more than one sector is first needed;
// set() changes only the values.
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
#include "models/fe_tire/mesh/materials.h"
#include "models/fe_tire/mesh/mesh.h"

namespace latsch::fe_tire {

/// Equilibrium of the inflated tire with clamped rim, the same in every sector.
struct Inflated {
  double pressure = 0.0;  // Pa
  /// rad/s about +y; if not 0, the tire has grown by its rotation (motion/spin.h)
  double spin = 0.0;
  /// [3 x nodes_per_sector], displacements in the sector frame, m  (S = 1: the whole mesh)
  Eigen::Matrix3Xd u;
  Eigen::VectorXd alpha;  // enhanced strain parameters of the elements in one sector
  double growth = 0.0;    // m, radial displacement of the tread node nearest to the middle plane
  double radius = 0.0;    // m, distance of the lowest tread point from the wheel center
  double width = 0.0;     // m, width of the section from sidewall to sidewall
};

/// Equilibrium on or above the ground, with clamped rim.
struct TireState {
  std::shared_ptr<const Inflated> inflated;  // inflated state from which the loading started
  Ground ground;                             // the ground on which the tire stands
  GroundPose pose;                           // pose of the ground relative to the wheel
  /// True if all poses stay below the wheel center (GroundPose::is_below) and symmetry allows half
  /// of the ring to represent all of it.
  bool is_halved = false;
  /// Index of the part of the tread that may touch (a half angle, see TreadSurface); it grows with
  /// the load.
  int window = 0;
  Eigen::Matrix3Xd u;  // [3 x nodes], displacements in sector frames, m
  /// Enhanced strain parameters of the elements in this half or whole ring. They are part of the
  /// state because they can be found only from a nearby state.
  Eigen::VectorXd alpha;
  /// Points to which friction attaches the tread; empty without friction.
  std::vector<Anchor> anchors;

  /// Deflection, m, from first touch of the inflated tire on flat ground.
  double deflection() const { return inflated->radius - pose.height; }
};

/// Loads and contact patch of a state as a rig measures them.
struct Standing {
  double deflection = 0.0;     // m, measured from first touch of the inflated tire
  double loaded_radius = 0.0;  // m, distance from wheel center to ground
  /// Force and moment of the ground on the tire. The axes are level with the ground, with x in the
  /// heading of the wheel.
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   // N
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();  // N m, about the wheel center
  ContactPatch patch;                                // size and area of the contact
};

/// Direction in which the belt mainly moves.
enum class ModeType { torsional, lateral, radial, other };
std::string name(ModeType type);  // "torsional"
/// Returns the type with this name, or nullopt if there is none.
std::optional<ModeType> mode_type(const std::string& name);

/// A vibration mode of the tire with clamped rim.
struct Mode {
  double frequency = 0.0;           // Hz
  int n = 0;                        // dominant circumferential number
  ModeType type = ModeType::other;  // main direction of the belt's motion
  int order = 1;  // 1, 2, ... among modes of equal n and type, in ascending frequency
  /// For a loaded tire: 's' symmetric, 'a' antisymmetric in x. ' ' for an unloaded tire.
  char phase = ' ';
  Eigen::Matrix3Xd
      /// [3 x nodes], sector frames, mass-normalized; the two modes of an unloaded pair are
      /// orthogonal
      shape;
  /// Returns the name of the mode, such as "lateral n=1", "radial n=2 a", "radial n=3 (2)".
  std::string label() const;
};

struct TireDescription;

class FeTire {
 public:
  /// Makes a tire from a mesh and its materials.
  FeTire(Mesh mesh, Materials materials, SolverSettings settings = {});
  /// Makes a tire from a description, with its mesh, materials and element kind.
  explicit FeTire(const TireDescription& description);
  ~FeTire();
  /// A tire can be moved but not copied.
  FeTire(FeTire&&) noexcept;
  /// Takes over mesh, materials and solver of the other tire.
  FeTire& operator=(FeTire&&) noexcept;

  /// The mesh of the unloaded tire.
  const Mesh& mesh() const;
  /// The current materials.
  const Materials& materials() const;
  /// Replaces the materials. The mesh remains.
  void set(Materials materials);

  /// Returns the equilibrium of the tire under this pressure, Pa, with clamped rim. A Failure names
  /// the load step and the residual.
  Result<Inflated> inflate(double pressure);
  /// Returns the same equilibrium, starting from nearby displacements that were computed on another
  /// mesh (section_grid.h).
  Result<Inflated> inflate(double pressure, const Eigen::Matrix3Xd& near);

  /// Poses of the ground that will follow. `below`: the ground always stays below the wheel center.
  enum class Poses { below, any };
  /// Returns the inflated tire on this ground at the height of first touch. If all poses are below
  /// the wheel center and the ground is symmetric, half of the ring represents all of it.
  TireState over(const Inflated& inflated, const Ground& ground, Poses poses = Poses::below);
  /// Returns the pose of the ground at a deflection, m, measured from first touch of the inflated
  /// tire.
  static GroundPose below(const Inflated& inflated, double deflection) {
    return {.height = inflated.radius - deflection};
  }
  /// Moves the ground from pose to pose and finds the equilibrium at each. With friction the result
  /// depends on the path. A Failure names the pose, the residual and the worst element. A Failure
  /// is also returned if the last equilibrium is unstable.
  Result<std::vector<TireState>> advance(const TireState& from,
                                         const std::vector<GroundPose>& poses);
  /// Moves the tire straight down to these deflections (m, from first touch), one after the other,
  /// and returns the state at each.
  Result<std::vector<TireState>> press(const Inflated& inflated,
                                       const Ground& ground,
                                       const std::vector<double>& deflections);
  /// Returns loads and contact patch of a state, as a rig would measure them.
  Standing stand(const TireState& state);
  /// Returns the points that touch in a state. Given as Ground::held, they define this state's
  /// branch of equilibria: another pose, or another tire whose mesh has the same topology, can be
  /// computed with exactly these points in contact.
  TouchingPoints touching(const TireState& state);

  /// Computes the `count` lowest modes of the inflated, unloaded tire by circumferential harmonics.
  Result<std::vector<Mode>> modes(const Inflated& inflated, int count);
  /// Computes the `count` lowest modes by a full eigenvalue problem of the whole ring, for
  /// comparison.
  Result<std::vector<Mode>> modes_full(const Inflated& inflated, int count);
  /// Computes the `count` lowest modes about the state. Points in contact stay in contact; with
  /// friction they stick.
  Result<std::vector<Mode>> modes(const TireState& state, int count);

  double total_mass() const;  // kg
  /// Returns mass and moments of inertia of the inflated tire.
  MassProperties mass_properties(const Inflated& inflated) const;
  /// Returns the numbers of iterations and factorizations since the last reset.
  SolverCounts counts() const;
  /// Resets all counts to 0.
  void reset_counts();

 private:
  friend class TireSlopes;
  friend class SpinningTire;
  friend class RollingTire;
  friend class RollingResponse;
  friend class RollingTransient;
  friend class FeRollingTire;
  friend class LossMeter;
  friend class DampedTire;
  friend class TireResponse;
  friend struct Varied;
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace latsch::fe_tire
