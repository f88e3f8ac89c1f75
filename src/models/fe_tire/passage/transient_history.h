// SPDX-License-Identifier: Apache-2.0
// Forces of the history that the rubber and the cords of a tire carry along streamlines while its
// state changes in time.
//
// In a step h of time the material at a place comes from the place Omega h upstream. With the
// deviations dS, dH_i of stress and history from those of the steady state at the start,
//   dH_i(t + h) = e^(-a_i) dH_i* + c_i beta_i (dS(t + h) - dS*),                             (H.7)
//   a = h/tau, c = (1 - e^(-a))/a
// where * are the values of the last step at the place upstream, by the cubic through the four
// sectors around. It is (H.1) for stresses that change linearly within the step. The steady state
// itself obeys (H.2) of rolling_history.h and does not change, however long the passage lasts.
#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <utility>
#include <vector>

#include "models/fe_tire/rolling/rolling_history.h"

namespace latsch::fe_tire {

/// Returns the part of a change of stress over one step, s, that is left at its end, relative to
/// the relaxed stress: beta (1 - e^(-a))/a.
double fresh_share(const PronyTerm& term, double step);

class TransientHistory : public RollingHistory {
 public:
  using RollingHistory::RollingHistory;

  /// Begins with a steady state whose material passes with Omega, rad/s.
  void start(const RingUnknowns& unknowns, const AssembledState& steady, double Omega);
  /// Begins a step of `h`, s, during which material passes with Omega, rad/s.
  void begin_step(double h, double Omega);
  /// Computes the history of an iterate of the step.
  void update_step(const RingUnknowns& unknowns, const AssembledState& state) {
    follow(unknowns, state);
  }
  /// Stiffens the laws by m of each series in place of what a step leaves of it, and computes the
  /// history of a state; begin_step() undoes this.
  void stiffen(const std::vector<double>& m,
               const RingUnknowns& unknowns,
               const AssembledState& state);
  /// Prony series that differ.
  const std::vector<PronyTerms>& series() const { return series_; }
  /// Takes the last iterate as the end of the step.
  void end_step();

  /// Stresses and histories of the steady state, [section element], [rows x sectors].
  struct Steady {
    std::vector<Eigen::MatrixXd> S, H;
  };
  /// Everything that the material remembers at the end of the last step, for going back to it: the
  /// steady state, which does not change, and the deviations from it.
  struct Memory {
    std::shared_ptr<const Steady> steady;
    std::vector<Eigen::MatrixXd> S;               // [section element], [rows x sectors]
    std::vector<std::vector<Eigen::MatrixXd>> H;  // [section element][part and term]
  };
  const Memory& memory() const { return last_; }
  /// Goes back to what was remembered once; steps then begin there.
  void set_memory(Memory of);

 private:
  /// Rows of an element that relax by one series, and the stiffness of a linear solid, whose rows
  /// are strains.
  struct Part {
    int series;
    Eigen::Index first, rows;
    const Matrix6* D = nullptr;
  };
  /// Sectors around the place upstream of a sector, and their weights.
  struct Around {
    std::array<int, 4> sectors;
    std::array<double, 4> weights;
  };
  Eigen::MatrixXd history(int element, const Eigen::MatrixXd& S) override;
  std::vector<Part> parts(int element) const;
  void find_upstream(double angle);
  Eigen::MatrixXd upstream(const Eigen::MatrixXd& of) const;
  static void add(const Part& part, const Eigen::MatrixXd& h, Eigen::MatrixXd& H);

  bool is_steady_ = true;                     // the state that is followed is the steady one
  double step_ = 0.0, stiffened_step_ = 0.0;  // s
  std::vector<Around> around_;                // one for every sector
  Steady start_;                              // the steady state while it is found
  Memory last_, next_;  // next_.S: of the last iterate; next_.H: the known part of (H.7)
  std::vector<Eigen::MatrixXd> sum_;  // H_0 and the known parts
};

}  // namespace latsch::fe_tire
