// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/slopes/moved_numbers.h"

namespace latsch::fe_tire {
namespace {

constexpr int kLanes = ElementBatch::kLanes;

/// Computes phi^T dM phi for the mode of the motion in every lane.
void mass_along(const Matrix8& dM, const ElementMotion& motion, double (&sums)[kLanes]) {
  for (double& sum : sums) sum = 0.0;
  for (int a = 0; a < 8; ++a) {
    for (int b = 0; b <= a; ++b) {
      const double m = b < a ? 2.0 * dM(a, b) : dM(a, a);
      for (int c = 0; c < 3; ++c) {
        const double *u = motion.mode[3 * a + c], *v = motion.mode[3 * b + c];
        for (int lane = 0; lane < kLanes; ++lane) sums[lane] += m * (u[lane] * v[lane]);
      }
    }
  }
}

}  // namespace

void FeltNumbers::find(int sector, int element, const std::vector<MovedNumber>& moved) {
  elements.clear();
  numbers.clear();
  masses.clear();
  for (std::size_t k = 0; k < moved.size(); ++k) {
    const MovedNumber& number = moved[k];
    const MovedNumber::Parts& parts = (*number.parts)[element];
    if (parts.mass) masses.push_back(k);
    if (!parts.any()) continue;
    const bool inner = number.below->ring().mesh().elements[element].inner;
    const auto add = [&](const RingElements& other, double pressure) {
      elements.push_back({&other.law(sector, element),
                          inner ? pressure : 0.0,
                          parts.solid,
                          parts.gas && inner,
                          parts.cords});
    };
    add(*number.below, number.pressure_below);
    add(*number.above, number.pressure_above);
    numbers.push_back(k);
  }
}

bool sum_differences(const ElementLaw& law,
                     unsigned open_edges,
                     const FeltNumbers& felt,
                     const std::vector<MovedNumber>& moved,
                     ElementBatch& batch,
                     std::vector<ElementMotion>& motions,
                     const LaneSink& sink) {
  if (!follow_along(law, batch, motions)) return false;
  std::vector<double> results(felt.elements.size() * motions.size() * kLanes);
  auto* lanes = reinterpret_cast<double(*)[kLanes]>(results.data());
  sum_motions(felt.elements, open_edges, batch, motions, lanes);
  for (std::size_t v = 0; v < felt.numbers.size(); ++v) {
    const std::size_t k = felt.numbers[v];
    for (std::size_t i = 0; i < motions.size(); ++i) {
      const double* below = lanes[2 * v * motions.size() + i];
      double(&above)[kLanes] = lanes[(2 * v + 1) * motions.size() + i];
      for (int lane = 0; lane < kLanes; ++lane)
        above[lane] = (above[lane] - below[lane]) / moved[k].way;
      sink(i, k, above);
    }
  }
  return true;
}

void sum_masses(int sector,
                int element,
                const FeltNumbers& felt,
                const std::vector<MovedNumber>& moved,
                const std::vector<ElementMotion>& motions,
                const LaneSink& sink) {
  for (const std::size_t k : felt.masses) {
    const auto of = [&](const RingElements& tire) {
      return mass(tire.ring().shape(sector, element),
                  tire.materials(),
                  tire.ring().mesh().elements[element]);
    };
    const Matrix8 dM = (of(*moved[k].above) - of(*moved[k].below)) / moved[k].way;
    double lanes[kLanes];
    for (std::size_t i = 0; i < motions.size(); ++i) {
      mass_along(dM, motions[i], lanes);
      sink(i, k, lanes);
    }
  }
}

}  // namespace latsch::fe_tire
