// SPDX-License-Identifier: Apache-2.0
// Kernels that evaluate the Magic Formula for one state, and for eight states at a time.
#include "models/magic_formula/steady_state.h"

namespace latsch::magic_formula::LATSCH_KERNELS {

// States and results are stored as structs of doubles. These functions convert eight structs to one
// struct of vectors, and back.

template <class Fields>
constexpr int kFieldsOf = sizeof(Fields) / sizeof(double);

/// Converts eight structs of doubles to one struct of Lanes, field by field.
template <class Wide, class Narrow>
LATSCH_INLINE Wide side_by_side(const Narrow* eight) {
  static_assert(sizeof(Wide) == 8 * sizeof(Narrow));
  const auto field = [&](int state, int i) {
    double x;
    std::memcpy(&x, reinterpret_cast<const char*>(eight + state) + sizeof x * i, sizeof x);
    return x;
  };
  Wide wide;
  for (int i = 0; i < kFieldsOf<Narrow>; ++i)
    reinterpret_cast<Lanes*>(&wide)[i] = lanes(field(0, i),
                                               field(1, i),
                                               field(2, i),
                                               field(3, i),
                                               field(4, i),
                                               field(5, i),
                                               field(6, i),
                                               field(7, i));
  return wide;
}
template <class Wide, class Narrow>
LATSCH_INLINE void one_by_one(const Wide& wide, Narrow* eight) {
  static_assert(sizeof(Wide) == 8 * sizeof(Narrow));
  double fields[kFieldsOf<Narrow>][8];
  for (int i = 0; i < kFieldsOf<Narrow>; ++i)
    store(reinterpret_cast<const Lanes*>(&wide)[i], fields[i]);
  for (int state = 0; state < 8; ++state) {
    double of_one[kFieldsOf<Narrow>];
    for (int i = 0; i < kFieldsOf<Narrow>; ++i) of_one[i] = fields[i][state];
    std::memcpy(eight + state, of_one, sizeof of_one);
  }
}

/// Evaluates one state. `wheel` receives the variables on which the deflection of MF 6.2 depends.
void evaluate_one(const TireConstants& tire,
                  const Conventions& conventions,
                  const State& state,
                  SteadyState& result,
                  WheelUnderLoad& wheel) {
  // Results are written directly to their final memory, because the processor would stall if it
  // copied values right after they were written.
  static_assert(sizeof(Lane) == sizeof(double));
  steady_state(tire,
               conventions,
               std::bit_cast<StateOf<Lane>>(state),
               reinterpret_cast<SteadyStateOf<Lane>&>(result),
               reinterpret_cast<WheelUnderLoadOf<Lane>&>(wheel));
}

void evaluate_eight(const TireConstants& tire,
                    const Conventions& conventions,
                    const State* states,
                    SteadyState* results,
                    WheelUnderLoad* wheels) {
  WheelUnderLoadOf<Lanes> at;
  SteadyStateOf<Lanes> s;
  steady_state(tire, conventions, side_by_side<StateOf<Lanes>>(states), s, at);
  one_by_one(s, results);
  if (wheels != nullptr) one_by_one(at, wheels);
}

/// Computes the forces of `count` states, a multiple of eight. The columns are in the order of the
/// fields of StateOf and Forces.
void forces_of_columns(const TireConstants& tire,
                       const Conventions& conventions,
                       const double* const* in,
                       double* const* out,
                       std::size_t count) {
  for (std::size_t i = 0; i < count; i += 8) {
    const StateOf<Lanes> state{lanes(in[0] + i),
                               lanes(in[1] + i),
                               lanes(in[2] + i),
                               lanes(in[3] + i),
                               lanes(in[4] + i),
                               lanes(in[5] + i),
                               lanes(in[6] + i)};
    const Forces<Lanes> f = forces_of<Lanes>(tire, conventions, state);
    store(f.Fx, out[0] + i);
    store(f.Fy, out[1] + i);
    store(f.Mx, out[2] + i);
    store(f.My, out[3] + i);
    store(f.Mz, out[4] + i);
  }
}

}  // namespace latsch::magic_formula::LATSCH_KERNELS
