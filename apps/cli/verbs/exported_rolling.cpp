// SPDX-License-Identifier: Apache-2.0
#include "cli/verbs/exported_rolling.h"

#include <fmt/format.h>

#include <map>
#include <memory>

#include "cli/console/console.h"
#include "cli/run/model_source.h"
#include "cli/run/test_argument.h"
#include "experiment/language/capabilities.h"
#include "experiment/rigs/fe_tire/rolling_chain_rig.h"
#include "experiment/rigs/fe_tire/rolling_footprint.h"
#include "experiment/tests/rolling_states.h"
#include "formats/mesh/vtu_file.h"
#include "models/fe_tire/contact/ground.h"
#include "models/fe_tire/grip/rolling_surface.h"
#include "models/fe_tire/rolling/rolling_fields.h"

namespace latsch::cli {
namespace {

namespace fs = std::filesystem;
using experiment::RolledState;
using formats::VtuField;

/// Writes the ring with its displacements, velocities, strains, stresses and losses.
void write_ring(const fs::path& file,
                const fe_tire::Mesh& mesh,
                const fe_tire::LossMeter& meter,
                const fe_tire::RollingState& state) {
  const auto fields = fe_tire::rolling_fields(meter, state.u, state.alpha, state.of.spin);
  std::vector<VtuField> cells = {{"E (rr, tt, yy, 2rt, 2ty, 2ry)", fields.E},
                                 {"S (rr, tt, yy, rt, ty, ry) [Pa]", fields.S},
                                 {"energy [J/m^3]", fields.energy},
                                 {"dissipation [W/m^3]", fields.dissipation}};
  for (const fe_tire::CordFields& cords : fields.cords) {
    cells.push_back({cords.name + " strain", cords.strain});
    cells.push_back({cords.name + " stress [Pa]", cords.stress});
    cells.push_back({cords.name + " force [N/m]", cords.force});
  }
  formats::write_tire_vtu(
      file, mesh, {{"displacement", state.u}, {"velocity [m/s]", fields.v}}, cells);
  say_written(file.string());
}

/// Places of the patch in the axes of the wheel, and vectors along the ground there.
class OnGround {
 public:
  explicit OnGround(const fe_tire::RollingCase& of)
      : pose_({}, {.height = of.height, .camber = of.camber}),
        surface_(of.curvature, {std::cos(of.slip_angle), std::sin(of.slip_angle)}),
        hub_(pose_.in_ground(Eigen::Vector3d::Zero())) {
    const Eigen::Vector3d down = pose_.in_ground(-Eigen::Vector3d::UnitZ()) - hub_;
    center_ = hub_ + hub_.z() / -down.z() * down;
  }
  Eigen::Vector3d place(double x, double y) const { return pose_.to_wheel(point(x, y) - hub_); }
  Eigen::Vector3d vector(double x, double y, const Eigen::Vector2d& along) const {
    const Eigen::Matrix3d turn = surface_.place(point(x, y)).turn;
    return pose_.to_wheel(turn.transpose() * Eigen::Vector3d(along.x(), along.y(), 0.0));
  }

 private:
  Eigen::Vector3d point(double x, double y) const {
    return surface_.point({x + center_.x(), y + center_.y()});
  }

  fe_tire::PosedGround pose_;
  fe_tire::RollingSurface surface_;
  Eigen::Vector3d hub_, center_;
};

/// Writes the points in contact: numbers in W as in the table of the test rolling_footprint, and
/// vectors in the axes of the wheel.
void write_patch(const fs::path& file, const fe_tire::RollingState& state) {
  const experiment::RollingFootprint print = experiment::footprint_of(state);
  const OnGround ground(state.of);
  const auto count = static_cast<Eigen::Index>(print.points.size());
  Eigen::Matrix3Xd x(3, count), shear(3, count), slide(3, count);
  Eigen::MatrixXd numbers(9, count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const experiment::RollingPoint& at = print.points[k];
    x.col(k) = ground.place(at.x, at.y);
    shear.col(k) = ground.vector(at.x, at.y, {at.shear_x, at.shear_y});
    slide.col(k) = ground.vector(at.x, at.y, {at.slide_x, at.slide_y});
    numbers.col(k) << at.pressure, at.shear_x, at.shear_y, at.slide_x, at.slide_y,
        std::hypot(at.slide_x, at.slide_y), at.grip, at.power, print.footprint.elements[k].area();
  }
  const char* names[] = {"p [Pa]",
                         "t_x [Pa]",
                         "t_y [Pa]",
                         "w_x [m/s]",
                         "w_y [m/s]",
                         "sliding speed [m/s]",
                         "grip",
                         "power [W/m^2]",
                         "area [m^2]"};
  std::vector<VtuField> fields = {{"shear [Pa]", shear}, {"sliding [m/s]", slide}};
  for (Eigen::Index k = 0; k < numbers.rows(); ++k) fields.push_back({names[k], numbers.row(k)});
  formats::write_points_vtu(file, {x, fields});
  say_written(file.string());
}

/// Writes the chains of one state as closed lines, with the numbers of the test rolling_chain.
void write_chains(const fs::path& file, const Channels& chains) {
  const auto count = static_cast<Eigen::Index>(chains["theta"].size());
  const auto rows = [&](const std::vector<const char*>& names) {
    Eigen::MatrixXd values(std::ssize(names), count);
    for (std::size_t i = 0; i < names.size(); ++i)
      values.row(static_cast<Eigen::Index>(i)) =
          Eigen::RowVectorXd::Map(chains[names[i]].data(), count);
    return values;
  };
  formats::VtuPoints points{rows({"x", "y", "z"}), {}};
  points.fields = {
      {"displacement", rows({"u_x", "u_y", "u_z"})},
      {"velocity [m/s]", rows({"v_x", "v_y", "v_z"})},
      {"acceleration [m/s^2]", rows({"a_x", "a_y", "a_z"})},
      {"E (rr, tt, yy, 2rt, 2ty, 2ry)", rows({"E_rr", "E_tt", "E_yy", "G_rt", "G_ty", "G_ry"})},
      {"S (rr, tt, yy, rt, ty, ry) [Pa]", rows({"S_rr", "S_tt", "S_yy", "S_rt", "S_ty", "S_ry"})}};
  for (const char* name :
       {"position", "theta", "cord_strain", "cord_stress", "cord_force", "energy", "dissipation"}) {
    const std::string& unit = chains.find(name)->unit;
    points.fields.push_back(
        {unit == "1" ? std::string(name) : fmt::format("{} [{}]", name, unit), rows({name})});
  }
  const std::vector<double>& positions = chains["position"];
  for (Eigen::Index k = 0; k < count; ++k) {
    if (k == 0 || positions[k] != positions[k - 1]) points.loops.push_back(0);
    ++points.loops.back();
  }
  formats::write_points_vtu(file, points);
  say_written(file.string());
}

/// Returns the name of a state's file: "tire.vtu", or "tire_2.vtu" of several states.
fs::path numbered(const fs::path& file, std::size_t state, std::size_t of) {
  if (of == 1) return file;
  return fs::path(file).replace_filename(
      fmt::format("{}_{}{}", file.stem().string(), state + 1, file.extension().string()));
}

Status write_states(experiment::TireRig& rig,
                    const experiment::RollsFeTire& test,
                    const fs::path& file) {
  const auto states = experiment::roll_states(rig, test.rolling());
  if (!states) return states.failure();
  std::map<double, std::unique_ptr<fe_tire::LossMeter>> meters;  // one for each pressure
  for (std::size_t k = 0; k < states->size(); ++k) {
    const RolledState& rolled = (*states)[k];
    auto& meter = meters[rolled.state.pressure];
    if (!meter) {
      const auto& inflated = rig.inflated(rolled.state.pressure);
      if (!inflated) return inflated.failure();
      meter = std::make_unique<fe_tire::LossMeter>(rig.tire(), rig.losses(), *inflated);
    }
    const fs::path ring = numbered(file, k, states->size());
    write_ring(ring, rig.tire().mesh(), *meter, rolled.state);
    write_patch(fs::path(ring).replace_extension(".patch.vtu"), rolled.state);
    if (const experiment::ChainPlaces* places = test.chain_places()) {
      const auto chains = experiment::chains_of(rig, {rolled}, *places);
      if (!chains) return chains.failure();
      write_chains(fs::path(ring).replace_extension(".chain.vtu"), *chains);
    }
  }
  return {};
}

}  // namespace

void write_rolling_vtu(const std::string& model,
                       const std::string& test,
                       const fs::path& file,
                       const experiment::Language& language) {
  const ModelSource source = model_source(model, language);
  const experiment::ReadTest read = test_argument(test, language);
  const auto* rolls = dynamic_cast<const experiment::RollsFeTire*>(read.test.get());
  if (!rolls)
    throw InputError("--rolling: this test (" + read.test->in_words() +
                     ") has no states of a finite-element tire that rolls; expected one of kind "
                     "rolling, rolling_footprint or rolling_chain");
  if (fs::exists(file) && !fs::is_regular_file(file))
    throw InputError("--rolling writes the patch beside " + file.string() +
                     ", which is not a regular file; expected the name of a file");
  const auto specimen = source.kind->build(source.numbers);
  auto* tire = specimen->find<experiment::IsFeTire>();
  if (!tire)
    throw InputError(model + " has a " + source.kind->in_words() +
                     ", expected a tire of finite elements, which has a mesh");
  const auto done = tire->drive(
      [&](experiment::TireRig& rig, fe_tire::TireSlopes*) -> Result<Channels> {
        const Status written = write_states(rig, *rolls, file);
        if (!written) return written.failure();
        return Channels();
      },
      rolls->rolling().pressure.has_value(),
      {});
  if (!done) throw std::runtime_error(done.failure().reason);
  for (const std::string& limit : rolls->limits(*specimen)) warn(limit);
}

}  // namespace latsch::cli
