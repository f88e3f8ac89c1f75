// SPDX-License-Identifier: Apache-2.0
// Internals of TireSlopes, which computes derivatives of the inflated tire on one sector
// (tire_slopes.cpp), of states on the ground (loaded_slopes.cpp), of their contact patch
// (patch_slopes.cpp), and of steady states of rolling (steady_slopes.cpp).
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
    // State to which the tangent belongs; not set if the tangent is not positive definite.
    std::optional<TireState> of;
  };
  // Factorized tangents about the last state for which the solver's own factorization could not be
  // used.
  std::map<const Systems*, Tangent> own_tangents;
  /// Solution w of (S.2) at an intermediate state of a path, computed while the solver's
  /// factorization was near.
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
  Impl(const Impl&) = delete;  // not copied, because the tire refers to this object
  int count() const { return static_cast<int>(variations.size()); }

  /// Returns the pressure, Pa, of the tire with a changed parameter, if the unchanged tire is under
  /// `pressure`.
  double pressure_of(int k, const VariedTire& tire, double pressure) const {
    return variations[k].moves_pressure ? tire.pressure : pressure;
  }

  Result<AtInflated> solve_inflated(const Inflated& at);
  /// Returns derivatives of omega^2 in rad^2/s^2 per unit [modes x parameters] of at most
  /// SectorMotions::kMost modes. of_inflated() must have been called before.
  Result<Eigen::MatrixXd> of_harmonic_modes(const Inflated& at,
                                            std::span<const HarmonicShape> modes);
  std::pair<Inflated, Inflated> moved_inflated(const Inflated& at,
                                               const Eigen::VectorXd& x_slope,
                                               int k) const;
  void pass(Systems& all, const TireState& state);
  /// Computes w of (S.2) for the right-hand side df/dh.
  Result<Eigen::VectorXd> motion_by_height(Systems& all,
                                           const TireState& state,
                                           const Eigen::VectorXd& f_h);
  /// Returns the memory in which the tangent about a state can be assembled and factorized.
  Tangent& tangent_for(Systems& all);
  /// Returns the factorization of the tangent about a state: that used for its modes, if they were
  /// computed, or a new one.
  Result<const numerics::Factorization*> factor(Systems& all, const TireState& state);
  /// Returns the given modes with shapes of the accuracy kSharp.
  Result<std::vector<Mode>> sharpened_modes(const TireState& state, std::vector<Mode> modes);
  Result<Eigen::MatrixXd> of_some_modes(const TireState& state,
                                        const std::vector<Mode>& modes,
                                        const Eigen::VectorXd& height);
  /// Selects the elements: those of the ring that is pressed on the ground, or of the ring with
  /// equally wide sectors.
  enum class OfRing { pressed, even };
  std::vector<MovedNumber> moved_numbers(OfRing of, double pressure) const;
  /// Adds the contribution of the tread, if a parameter changes its shape, to the sums. `change`
  /// computes this contribution [motions] from the touching points and their forces.
  using TouchChange = std::function<Eigen::VectorXd(const TreadSurface& tread,
                                                    const std::vector<TreadContact::Touch>& touches,
                                                    const Eigen::VectorXd& forces)>;
  const TreadSurface& tread_of(const Varied& tire, const Systems& all, bool is_halved);
  void add_tread(Systems& all,
                 const TireState& state,
                 const TouchChange& change,
                 Eigen::MatrixXd& sums);
  /// Computes the derivative dx/dp of a state on the ground by (S.1) [unknowns x parameters].
  Result<Eigen::MatrixXd> moved_state(Systems& all,
                                      const TireState& state,
                                      const Eigen::VectorXd& height);
  /// Returns the contact patch for parameter k decreased (-1) or increased (1), with the state
  /// moved to first order.
  ContactPatch patch_beside(Systems& all,
                            const TireState& state,
                            const Eigen::VectorXd& x,
                            double height,
                            int k,
                            double side);
  /// Returns df/dh and -dFz/dh at constant x for the assembled sectors.
  std::pair<Eigen::VectorXd, double> by_height(Systems& all, const TireState& state) const;
};

/// Accuracy of the mode shapes from which slopes are computed; it is used as
/// SolverSettings::mode_tolerance.
inline constexpr double kSharp = 3e-8;

/// Returns the Failure for an element that is inverted if a parameter changes.
Failure beside_state();

/// Converts a derivative of omega^2, rad^2/s^2 per unit, to one of the frequency, Hz per unit.
double to_hertz_slope(double omega_squared_slope, double frequency);

}  // namespace latsch::fe_tire
