// SPDX-License-Identifier: Apache-2.0
// What slopes are made of inside: those of the inflated tire, one sector (tire_slopes.cpp), and
// those of states on the ground (loaded_slopes.cpp).
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
    Eigen::Matrix3Xd u;  // of the state
    numerics::BandedCholesky K;
    OfInflated slopes;
  };
  std::optional<AtInflated> inflated;
  struct Tangent {
    numerics::SymmetricMatrix K;
    numerics::Factorization factor;
    std::optional<TireState> of;  // none: not definite
  };
  std::map<const Systems*, Tangent> own_tangents;  // of the last state that needed one
  /// w of (S.2), of states that a way passed: found while the solver's factor was near.
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
  Impl(const Impl&) = delete;  // the tire knows it
  int count() const { return static_cast<int>(variations.size()); }

  /// Pa of a varied tire where the tire itself is under `pressure`.
  double pressure_of(int k, const VariedTire& tire, double pressure) const {
    return variations[k].moves_pressure ? tire.pressure : pressure;
  }

  Result<AtInflated> solve_inflated(const Inflated& at);
  /// rad^2/s^2 a unit [modes x variables] of at most SectorMotions::kMost; after of_inflated().
  Result<Eigen::MatrixXd> of_harmonic_modes(const Inflated& at,
                                            std::span<const HarmonicShape> modes);
  std::pair<Inflated, Inflated> moved_inflated(const Inflated& at,
                                               const Eigen::VectorXd& x_slope,
                                               int k) const;
  void pass(Systems& all, const TireState& state);
  /// w of (S.2), df/dh its right-hand side.
  Result<Eigen::VectorXd> motion_by_height(Systems& all,
                                           const TireState& state,
                                           const Eigen::VectorXd& f_h);
  /// The tangent about a state, a place where it can be made and solved with.
  Tangent& tangent_for(Systems& all);
  /// Of the tangent about a state: that of its modes where they were asked for, or one of its own.
  Result<const numerics::Factorization*> factor(Systems& all, const TireState& state);
  /// The same modes, their shapes to kSharp.
  Result<std::vector<Mode>> sharpened_modes(const TireState& state, std::vector<Mode> modes);
  Result<Eigen::MatrixXd> of_some_modes(const TireState& state,
                                        const std::vector<Mode>& modes,
                                        const Eigen::VectorXd& height);
  /// With the elements of the ring, or of that of equally wide sectors.
  enum class OfRing { pressed, even };
  std::vector<MovedNumber> moved_numbers(OfRing of, double pressure) const;
  /// What the tread of a varied tire of another shape adds to the sums, of the points that touch:
  /// `change` gives it of them and their forces [motions].
  using TouchChange = std::function<Eigen::VectorXd(const TreadSurface& tread,
                                                    const std::vector<TreadContact::Touch>& touches,
                                                    const Eigen::VectorXd& forces)>;
  const TreadSurface& tread_of(const Varied& tire, const Systems& all, bool is_halved);
  void add_tread(Systems& all,
                 const TireState& state,
                 const TouchChange& change,
                 Eigen::MatrixXd& sums);
  /// dx/dp of (S.1) of a state on the ground [unknowns x variables].
  Result<Eigen::MatrixXd> moved_state(Systems& all,
                                      const TireState& state,
                                      const Eigen::VectorXd& height);
  /// The patch with number k moved to a side, -1 or 1, the state along with it to first order.
  ContactPatch patch_beside(Systems& all,
                            const TireState& state,
                            const Eigen::VectorXd& x,
                            double height,
                            int k,
                            double side);
  /// Of the height: df/dh and -dFz/dh|x, of what is assembled.
  std::pair<Eigen::VectorXd, double> by_height(Systems& all, const TireState& state) const;
};

/// SolverSettings::mode_tolerance of shapes that slopes are taken of.
inline constexpr double kSharp = 3e-8;

/// What is said where an element has no state while a number moves.
Failure beside_state();

/// Hz a unit of a number, of rad^2/s^2 a unit.
double to_hertz_slope(double omega_squared_slope, double frequency);

}  // namespace latsch::fe_tire
