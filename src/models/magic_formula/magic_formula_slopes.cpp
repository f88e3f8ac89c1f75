// SPDX-License-Identifier: Apache-2.0
#include "models/magic_formula/magic_formula_slopes.h"

#include <algorithm>
#include <iterator>
#include <optional>

#include "base/error.h"
#include "base/text.h"
#include "models/magic_formula/deflection_62.h"
#include "models/magic_formula/vertical/load_curve.h"

namespace latsch::magic_formula {
namespace {

/// Fields of eight states as doubles, with the derivatives of each field.
template <int fields>
struct FieldsOfEight {
  double values[fields][8];
  const SlopeBlock* slopes[fields] = {};
};
template <class Fields>
constexpr int kFieldsIn = sizeof(Fields) / sizeof(double);
using StateOfEight = FieldsOfEight<kFieldsIn<State>>;
using SteadyStateOfEight = FieldsOfEight<kFieldsIn<SteadyState>>;
using WheelOfEight = FieldsOfEight<kFieldsIn<WheelUnderLoad>>;

}  // namespace
}  // namespace latsch::magic_formula

#define LATSCH_KERNELS_IN "models/magic_formula/magic_formula_slopes_kernels.h"
#include "numerics/kernels/for_each_kernel_set.h"

namespace latsch::magic_formula {
namespace {

/// Largest number of variables for which one pass computes derivatives. One direction is reserved
/// for the deflection of MF 6.2.
constexpr std::size_t kVariables = SlopeArena::kDirections - 1;
constexpr int kSpare = SlopeArena::kDirections - 1;

constexpr const char* kStateNames[] = {"Fz", "kappa", "alpha", "gamma", "phit", "Vx", "p"};
static_assert(std::size(kStateNames) == kFieldsIn<State>);

/// Members of the coefficients in the order of parameter_fields().
using DualCoefficients = CoefficientsOf<DualNumber>;
constexpr DualNumber DualCoefficients::*kDualMembers[] = {
#define LATSCH_MEMBER(section, name, value, unit) &DualCoefficients::name,
    LATSCH_MAGIC_FORMULA_PARAMETERS(LATSCH_MEMBER)
#undef LATSCH_MEMBER
};

/// A variable of the derivatives: either a coefficient or a field of the state.
struct Variable {
  std::optional<std::size_t> coefficient, state;
};

Variable find_variable(const std::string& name) {
  Variable variable;
  const auto& fields = parameter_fields();
  for (std::size_t i = 0; i < fields.size(); ++i)
    if (fields[i].name == name) variable.coefficient = i;
  for (std::size_t i = 0; i < std::size(kStateNames); ++i)
    if (kStateNames[i] == name) variable.state = i;
  if (variable.coefficient || variable.state) return variable;
  std::vector<std::string> names(std::begin(kStateNames), std::end(kStateNames));
  for (const ParameterField& field : fields) names.emplace_back(field.name);
  throw InputError(in_quotes(name) + " is no coefficient of the Magic Formula and none of " +
                   list_of({std::begin(kStateNames), std::end(kStateNames)}) +
                   did_you_mean(name, names));
}

template <class Fields>
std::size_t field_of(double Fields::*member) {
  const Fields fields{};
  return &(fields.*member) - reinterpret_cast<const double*>(&fields);
}

AskedOutputs asked_for(std::span<const Output> outputs) {
  const auto any_of = [&](std::initializer_list<Output> these) {
    return std::find_first_of(outputs.begin(), outputs.end(), these.begin(), these.end()) !=
           outputs.end();
  };
  using S = SteadyState;
  AskedOutputs asked;
  asked.Mx = any_of({&S::Mx});
  asked.My = any_of({&S::My});
  asked.Mz = any_of({&S::Mz, &S::Mzr, &S::t});
  asked.deflection = any_of({&S::rho, &S::R_l, &S::Cz});
  asked.patch = any_of({&S::a, &S::b});
  asked.relaxation = any_of({&S::Cx, &S::Cy, &S::sigma_x, &S::sigma_y});
  return asked;
}

/// Computes derivatives with respect to up to kVariables variables. The results are stored in the
/// arena of this object.
class Pass {
 public:
  Pass(const MagicFormula& tire, std::span<const Variable> variables, const AskedOutputs& asked)
      : tire_(tire),
        plain_(tire.parameters(), tire.parameters().version),
        dual_(seeded(variables), tire.parameters().version),
        asked_(asked),
        start_(arena_.mark()) {}

  /// Evaluates eight states. The result is valid until the next call.
  const SteadyStateOfEight& eight(const State* states) {
    arena_.rewind(start_);
    for (int k = 0; k < 8; ++k)
      for (int i = 0; i < kFieldsIn<State>; ++i)
        state_.values[i][k] = reinterpret_cast<const double*>(states + k)[i];
    LATSCH_KERNEL(evaluate_with_slopes)
    (dual_, tire_.conventions(), asked_, state_, result_, wheel_);
    const bool has_curve = has_load_curve(tire_.parameters());
    if (asked_.deflection && has_curve) add_deflection_on_curve();
    if (asked_.deflection && !has_curve && tire_.parameters().version == Version::mf62)
      add_deflection();
    return result_;
  }

 private:
  DualCoefficients seeded(std::span<const Variable> variables) {
    DualCoefficients p;
    const auto& fields = parameter_fields();
    for (std::size_t i = 0; i < fields.size(); ++i)
      p.*kDualMembers[i] = tire_.parameters().*fields[i].member;
    for (std::size_t j = 0; j < variables.size(); ++j) {
      const DualNumber one = DualNumber::variable(0.0, static_cast<int>(j), arena_);
      if (const auto i = variables[j].coefficient) {
        DualNumber& x = p.*kDualMembers[*i];
        // If a coefficient is requested twice, it has a derivative in both directions.
        x.slopes = (DualNumber(0.0, x.slopes) + one).slopes;
      } else {
        const SlopeBlock*& slopes = state_.slopes[*variables[j].state];
        slopes = (DualNumber(0.0, slopes) + one).slopes;
      }
    }
    return p;
  }

  /// Returns field i of state k with its derivatives as one dual number.
  template <int fields>
  DualNumber alone(const FieldsOfEight<fields>& eight, std::size_t i, int k) {
    const SlopeBlock* of_eight = eight.slopes[i];
    if (of_eight == nullptr) return eight.values[i][k];
    const int count = __builtin_popcountll(of_eight->directions);
    SlopeBlock* made = arena_.make(of_eight->directions, 1);
    for (int j = 0; j < count; ++j) made->values()[j] = of_eight->values()[8 * j + k];
    return {eight.values[i][k], made};
  }

  /// Stores the dual numbers of eight states as one field of the result.
  void join(const DualNumber* eight, Output output) {
    std::uint64_t directions = 0;
    for (int k = 0; k < 8; ++k)
      if (eight[k].slopes != nullptr) directions |= eight[k].slopes->directions;
    SlopeBlock* made = arena_.make(directions, 8);
    double* to = made->values();
    for (std::uint64_t left = directions; left != 0; left &= left - 1)
      for (int k = 0; k < 8; ++k) *to++ = eight[k].slope(__builtin_ctzll(left));
    const std::size_t i = field_of(output);
    result_.slopes[i] = made;
    for (int k = 0; k < 8; ++k) result_.values[i][k] = eight[k].v;
  }

  void add_deflection() {
    DualNumber rho[8], R_l[8], Cz[8];
    using W = WheelUnderLoad;
    for (int k = 0; k < 8; ++k) {
      const auto of_wheel = [&](double W::*member) { return alone(wheel_, field_of(member), k); };
      const WheelUnderLoadOf<DualNumber> o{of_wheel(&W::Fz),
                                           of_wheel(&W::Fz_given),
                                           of_wheel(&W::omega),
                                           of_wheel(&W::gamma),
                                           of_wheel(&W::dpi),
                                           of_wheel(&W::R_omega)};
      const DualNumber Fx = alone(result_, field_of(&SteadyState::Fx), k),
                       Fy = alone(result_, field_of(&SteadyState::Fy), k);
      const bool mirrored = tire_.conventions().mirrored;
      const DualDeflection62 d =
          deflection_62(plain_, dual_, o, Fx, mirrored ? -Fy : Fy, kSpare, arena_);
      rho[k] = d.rho;
      R_l[k] = d.R_l;
      Cz[k] = d.rho.v > 0.0 ? o.Fz / d.rho : dual_.p.VERTICAL_STIFFNESS;
    }
    join(rho, &SteadyState::rho);
    join(R_l, &SteadyState::R_l);
    join(Cz, &SteadyState::Cz);
  }

  void add_deflection_on_curve() {
    DualNumber rho[8], R_l[8], Cz[8];
    using W = WheelUnderLoad;
    for (int k = 0; k < 8; ++k) {
      const DualNumber Fz = alone(wheel_, field_of(&W::Fz), k);
      const DualNumber R_omega = alone(wheel_, field_of(&W::R_omega), k);
      rho[k] = deflection_on_curve(tire_.parameters(), Fz < dual_.p.FZMIN ? dual_.p.FZMIN : Fz);
      R_l[k] = R_omega > rho[k] ? R_omega - rho[k] : DualNumber(0.0);
      Cz[k] = rho[k].v > 0.0 ? Fz / rho[k] : DualNumber(initial_stiffness(tire_.parameters()));
    }
    join(rho, &SteadyState::rho);
    join(R_l, &SteadyState::R_l);
    join(Cz, &SteadyState::Cz);
  }

  const MagicFormula& tire_;
  SlopeArena arena_;
  StateOfEight state_;
  SteadyStateOfEight result_;
  WheelOfEight wheel_;
  TireConstants plain_;
  TireConstantsOf<DualNumber> dual_;
  AskedOutputs asked_;
  SlopeArena::Mark start_;
};

/// Copies the derivatives of one output for `here` states to the rows of `to` from row `at` on.
/// `to` must contain zeros.
void put_slopes(const SlopeBlock* slopes,
                std::size_t first,
                Eigen::Index at,
                Eigen::Index here,
                Eigen::MatrixXd& to) {
  if (slopes == nullptr) return;
  const double* from = slopes->values();
  for (std::uint64_t left = slopes->directions; left != 0; left &= left - 1, from += 8) {
    const Eigen::Index j = first + __builtin_ctzll(left);
    if (j >= to.cols()) break;  // the reserved direction belongs to no variable
    double* column = &to(at, j);
    if (here == 8)
      for (int k = 0; k < 8; ++k) column[k] = from[k];
    else
      std::copy_n(from, here, column);
  }
}

}  // namespace

void steady_state_slopes(const MagicFormula& tire,
                         std::span<const State> states,
                         std::span<const std::string> variables,
                         std::span<const Output> outputs,
                         SteadyStateSlopes& found) {
  std::vector<Variable> places;
  for (const std::string& name : variables) places.push_back(find_variable(name));
  const Eigen::Index count = states.size();
  found.values.resize(count, outputs.size());
  found.slopes.resize(outputs.size());
  for (Eigen::MatrixXd& slopes : found.slopes) slopes.setZero(count, variables.size());
  std::vector<std::size_t> fields;
  for (const Output output : outputs) fields.push_back(field_of(output));
  const AskedOutputs asked = asked_for(outputs);

  for (std::size_t first = 0; first == 0 || first < places.size(); first += kVariables) {
    const auto these = std::span(places).subspan(first);
    Pass pass(tire, these.first(std::min(these.size(), kVariables)), asked);
    for (Eigen::Index at = 0; at < count; at += 8) {
      State eight[8];
      const Eigen::Index here = std::min<Eigen::Index>(8, count - at);
      for (int k = 0; k < 8; ++k) eight[k] = states[at + std::min<Eigen::Index>(k, here - 1)];
      const SteadyStateOfEight& s = pass.eight(eight);
      for (std::size_t o = 0; o < outputs.size(); ++o) {
        std::copy_n(s.values[fields[o]], here, &found.values(at, o));
        put_slopes(s.slopes[fields[o]], first, at, here, found.slopes[o]);
      }
    }
  }
}

SteadyStateSlopes steady_state_slopes(const MagicFormula& tire,
                                      std::span<const State> states,
                                      std::span<const std::string> variables,
                                      std::span<const Output> outputs) {
  SteadyStateSlopes found;
  steady_state_slopes(tire, states, variables, outputs, found);
  return found;
}

}  // namespace latsch::magic_formula
