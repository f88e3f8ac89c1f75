// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/passage/transient_history.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace latsch::fe_tire {

double fresh_share(const PronyTerm& term, double step) {
  const double a = step / term.tau;
  return a > 0.0 ? term.beta * -std::expm1(-a) / a : term.beta;
}

std::vector<TransientHistory::Part> TransientHistory::parts(int element) const {
  constexpr Eigen::Index kSolid = 6 * kPairs;
  const Relaxing& of = relaxing_[element];
  std::vector<Part> parts;
  if (of.rubber >= 0) parts.push_back({of.rubber, 0, kSolid + 3});
  for (const LinearPart& part : of.parts) parts.push_back({part.series, 0, kSolid, &part.D});
  for (std::size_t k = 0; k < of.cords.size(); ++k)
    if (of.cords[k] >= 0)
      parts.push_back(
          {of.cords[k], kSolid + 3 + kCordPairs * static_cast<Eigen::Index>(k), kCordPairs});
  return parts;
}

/// Adds a history of a part's rows to that of all rows of the element.
void TransientHistory::add(const Part& part, const Eigen::MatrixXd& h, Eigen::MatrixXd& H) {
  if (part.D == nullptr) {
    H.middleRows(part.first, part.rows) += h;
    return;
  }
  for (int pair = 0; pair < kPairs; ++pair)
    H.middleRows<6>(6 * pair).noalias() += *part.D * h.middleRows<6>(6 * pair);
}

void TransientHistory::start(const RingUnknowns& unknowns,
                             const AssembledState& steady,
                             double Omega) {
  const std::size_t elements = relaxing_.size();
  start_.S.assign(elements, {});
  start_.H.assign(elements, {});
  last_ = {};
  is_steady_ = true;
  update(unknowns, steady, Omega);
  is_steady_ = false;
  stiffened_step_ = 0.0;
  const auto steady_state = std::make_shared<const Steady>(std::exchange(start_, {}));
  last_.steady = steady_state;
  last_.S.resize(elements);
  last_.H.resize(elements);
  for (std::size_t e = 0; e < elements; ++e) {
    last_.S[e] = 0.0 * steady_state->S[e];
    for (const Part& part : parts(static_cast<int>(e)))
      for (std::size_t term = 0; term < series_[part.series].size(); ++term)
        last_.H[e].push_back(Eigen::MatrixXd::Zero(part.rows, steady_state->S[e].cols()));
  }
  next_ = last_;
  sum_ = steady_state->H;
}

void TransientHistory::set_memory(Memory of) {
  last_ = std::move(of);
  next_ = last_;
  sum_ = last_.steady->H;
}

/// Finds the sectors around the places that are `angle`, rad, upstream of the sectors' middles.
void TransientHistory::find_upstream(double angle) {
  const Mesh& mesh = elements_.ring().mesh();
  const int m = mesh.sectors;
  const auto middle = [&](int s) {  // sectors of any turn
    const int turn = s >= 0 ? s / m : -((m - 1 - s) / m), in = s - turn * m;
    const double end = in + 1 < m ? mesh.angle(in + 1) : 2.0 * std::numbers::pi;
    return 0.5 * (mesh.angle(in) + end) + turn * 2.0 * std::numbers::pi;
  };
  around_.clear();
  for (int s = 0, before = 0; s < m; ++s) {
    const double at = middle(s) + angle;
    before = std::max(before, s);
    while (middle(before + 1) <= at) ++before;
    Around around;
    for (int k = 0; k < 4; ++k) {
      const int sector = before - 1 + k;
      around.sectors[k] = ((sector % m) + m) % m;
      around.weights[k] = 1.0;
      for (int other = before - 1; other < before + 3; ++other)
        if (other != sector)
          around.weights[k] *= (at - middle(other)) / (middle(sector) - middle(other));
    }
    around_.push_back(around);
  }
}

/// Returns values of the sectors as they are at the places upstream.
Eigen::MatrixXd TransientHistory::upstream(const Eigen::MatrixXd& of) const {
  Eigen::MatrixXd found(of.rows(), of.cols());
  for (Eigen::Index s = 0; s < of.cols(); ++s) {
    const auto& [sectors, weights] = around_[s];
    found.col(s) = weights[0] * of.col(sectors[0]) + weights[1] * of.col(sectors[1]) +
                   weights[2] * of.col(sectors[2]) + weights[3] * of.col(sectors[3]);
  }
  return found;
}

void TransientHistory::begin_step(double h, double Omega) {
  step_ = h;
  find_upstream(Omega * h);
  if (stiffened_step_ != h) {
    std::vector<double> fresh;
    for (const PronyTerms& terms : series_) {
      fresh.push_back(0.0);
      for (const PronyTerm& term : terms) fresh.back() += fresh_share(term, h);
    }
    stiffen_by(std::move(fresh));
    stiffened_step_ = h;
  }
  for (std::size_t e = 0; e < relaxing_.size(); ++e) {
    if (last_.H[e].empty()) continue;
    sum_[e] = last_.steady->H[e];
    const Eigen::MatrixXd S = upstream(last_.S[e]);
    std::size_t at = 0;
    for (const Part& part : parts(static_cast<int>(e))) {
      for (const PronyTerm& term : series_[part.series]) {
        Eigen::MatrixXd& known = next_.H[e][at];
        known = std::exp(-h / term.tau) * upstream(last_.H[e][at]) -
                fresh_share(term, h) * S.middleRows(part.first, part.rows);
        add(part, known, sum_[e]);
        ++at;
      }
    }
  }
}

void TransientHistory::stiffen(const std::vector<double>& m,
                               const RingUnknowns& unknowns,
                               const AssembledState& state) {
  stiffen_by(m);
  stiffened_step_ = 0.0;
  follow(unknowns, state);
}

Eigen::MatrixXd TransientHistory::history(int element, const Eigen::MatrixXd& S) {
  if (is_steady_) {
    start_.S[element] = S;
    start_.H[element] = RollingHistory::history(element, S);
    return start_.H[element];
  }
  next_.S[element] = S - last_.steady->S[element];
  Eigen::MatrixXd H = sum_[element];
  for (const Part& part : parts(element))
    add(part, stiffer_[part.series] * next_.S[element].middleRows(part.first, part.rows), H);
  return H;
}

void TransientHistory::end_step() {
  last_.S = next_.S;
  for (std::size_t e = 0; e < relaxing_.size(); ++e) {
    std::size_t at = 0;
    for (const Part& part : parts(static_cast<int>(e)))
      for (const PronyTerm& term : series_[part.series]) {
        last_.H[e][at] = next_.H[e][at] +
                         fresh_share(term, step_) * next_.S[e].middleRows(part.first, part.rows);
        ++at;
      }
  }
}

}  // namespace latsch::fe_tire
