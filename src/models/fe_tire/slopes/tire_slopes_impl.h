// SPDX-License-Identifier: Apache-2.0
// Internals of slopes: of the inflated tire on one sector (tire_slopes.cpp), and of states on the
// ground (loaded_slopes.cpp; their patch: patch_slopes.cpp).
#pragma once

#include <Eigen/Core>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "models/fe_tire/analysis/fe_tire_impl.h"
#include "models/fe_tire/slopes/ring_motions.h"
#include "models/fe_tire/slopes/sector_motions.h"
#include "models/fe_tire/slopes/tire_slopes.h"
#include "models/fe_tire/slopes/varied_tire.h"
#include "numerics/sparse/banded_hermitian.h"

namespace latsch::fe_tire {

struct TireSlopes::Impl {
  FeTire::Impl& base;
  std::vector<Variation> variations;
  std::vector<std::unique_ptr<VariedPair>> varied;
  struct AtInflated {
    Eigen::Matrix3Xd u;  // displacements of the state
    numerics::BandedCholesky K;
    OfInflated slopes;
  };
  std::optional<AtInflated> inflated;
  struct Tangent {
    numerics::SymmetricMatrix K;
    numerics::Factorization factor;
    std::optional<TireState> of;  // none: the tangent is not positive definite
  };
  std::map<const Systems*, Tangent> own_tangents;  // tangents of the last state that needed one
  /// w of (S.2) at the intermediate states of a path, found while the solver's factor was near.
  struct Passed {
    TireState state;
    Eigen::VectorXd w;
  };
  std::vector<Passed> passed;
  std::map<std::pair<const Varied*, const Systems*>, std::unique_ptr<VariedTread>> varied_treads;

  Impl(FeTire::Impl& tire, std::vector<Variation> numbers)
      : base(tire), variations(std::move(numbers)) {
    for (const Variation& v : variations) varied.push_back(std::make_unique<VariedPair>(v, base));
    base.on_passing = [this](Systems& all, const TireState& state) { pass(all, state); };
  }
  ~Impl() { base.on_passing = nullptr; }
  Impl(const Impl&) = delete;  // the tire refers to this object
  int count() const { return static_cast<int>(variations.size()); }

  /// Pressure of a varied tire, Pa, if the tire itself is under `pressure`.
  double pressure_of(int k, const VariedTire& tire, double pressure) const {
    return variations[k].moves_pressure ? tire.pressure : pressure;
  }

  Result<AtInflated> solve_inflated(const Inflated& at);
  /// Slopes in rad^2/s^2 per unit [modes x variables] of at most SectorMotions::kMost modes. Call
  /// it after of_inflated().
  Result<Eigen::MatrixXd> of_harmonic_modes(const Inflated& at,
                                            std::span<const HarmonicShape> modes);
  std::pair<Inflated, Inflated> moved_inflated(const Inflated& at,
                                               const Eigen::VectorXd& x_slope,
                                               int k) const;
  void pass(Systems& all, const TireState& state);
  /// Computes w of (S.2) with the right-hand side df/dh.
  Result<Eigen::VectorXd> motion_by_height(Systems& all,
                                           const TireState& state,
                                           const Eigen::VectorXd& f_h);
  /// Storage in which the tangent about a state can be assembled and factorized.
  Tangent& tangent_for(Systems& all);
  /// Returns the factorization of the tangent about a state: that of its modes if they were
  /// computed, or a new one.
  Result<const numerics::Factorization*> factor(Systems& all, const TireState& state);
  /// Returns the given modes with shapes solved to kSharp.
  Result<std::vector<Mode>> sharpened_modes(const TireState& state, std::vector<Mode> modes);
  Result<Eigen::MatrixXd> of_some_modes(const TireState& state,
                                        const std::vector<Mode>& modes,
                                        const Eigen::VectorXd& height);
  /// Selects the elements of the pressed ring, or of the ring with equally wide sectors.
  enum class OfRing { pressed, even };
  std::vector<MovedNumber> moved_numbers(OfRing of, double pressure) const;
  /// Adds the contribution of the tread of a varied tire with another shape to the sums. `change`
  /// computes it [motions] from the touching points and their forces.
  using TouchChange = std::function<Eigen::VectorXd(const TreadSurface& tread,
                                                    const std::vector<TreadContact::Touch>& touches,
                                                    const Eigen::VectorXd& forces)>;
  const TreadSurface& tread_of(const Varied& tire, const Systems& all, bool is_halved);
  void add_tread(Systems& all,
                 const TireState& state,
                 const TouchChange& change,
                 Eigen::MatrixXd& sums);
  /// Computes dx/dp of (S.1) of a state on the ground [unknowns x variables].
  Result<Eigen::MatrixXd> moved_state(Systems& all,
                                      const TireState& state,
                                      const Eigen::VectorXd& height);
  /// Patch with number k moved to a side, -1 or 1, and the state moved with it to first order.
  ContactPatch patch_beside(Systems& all,
                            const TireState& state,
                            const Eigen::VectorXd& x,
                            double height,
                            int k,
                            double side);
  /// Returns df/dh and -dFz/dh|x of the assembled sectors.
  std::pair<Eigen::VectorXd, double> by_height(Systems& all, const TireState& state) const;
};

/// Value of SolverSettings::mode_tolerance for shapes from which slopes are computed.
inline constexpr double kSharp = 3e-8;

/// Returns the failure reported if an element has no state while a number moves.
Failure beside_state();

/// Converts a slope of omega^2, rad^2/s^2 per unit, to Hz per unit.
double to_hertz_slope(double omega_squared_slope, double frequency);

}  // namespace latsch::fe_tire
