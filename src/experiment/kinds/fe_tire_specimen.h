// SPDX-License-Identifier: Apache-2.0
// The finite-element tire as a specimen, on any mesh.
#pragma once

#include <functional>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "experiment/language/capabilities.h"
#include "experiment/language/specimen.h"
#include "experiment/rigs/fe_tire/tire_footprint.h"
#include "experiment/rigs/fe_tire/tire_rig.h"
#include "models/fe_tire/analysis/fe_tire.h"
#include "models/fe_tire/slopes/tire_slopes.h"

namespace latsch::experiment {

/// A tire with its derivatives, which are computed once for all tests of a trial.
class SlopedTire {
 public:
  /// Returns the tire described by a file with these numbers, on this mesh.
  using Varied = std::function<fe_tire::VariedTire(const Document&)>;

  SlopedTire(fe_tire::FeTire tire, Varied varied)
      : tire_(std::make_unique<fe_tire::FeTire>(std::move(tire))), varied_(std::move(varied)) {}

  fe_tire::FeTire& tire() const { return *tire_; }
  /// Sets other materials on the same mesh and keeps the symbolic work on it.
  void set(fe_tire::Materials materials);
  Result<fe_tire::TireSlopes*> slopes_in(const std::vector<std::string>& paths,
                                         const Document& numbers);

 private:
  std::unique_ptr<fe_tire::FeTire> tire_;  // referred to by slopes_
  Varied varied_;
  std::vector<std::string> paths_;  // paths of slopes_
  std::unique_ptr<fe_tire::TireSlopes> slopes_;
};

class FeTireSpecimen : public Specimen,
                       public IsPressed,
                       public Vibrates,
                       public IsFeTire,
                       public HasFootprint,
                       public HasSteadyStates,
                       public LagsBehindSlips,
                       public Rolls,
                       public TakesConditions {
 public:
  using Varied = SlopedTire::Varied;

  /// `pressure`, Pa, applies to tests that state none.
  FeTireSpecimen(fe_tire::FeTire tire, double pressure, Document numbers, Varied varied);

  Result<Channels> press(const LoadDeflection& test, const Asked& asked) override;
  Result<Channels> vibrate(const ModalTest& test, const Asked& asked) override;
  Eigen::Matrix3Xd sensor_points() const override { return default_points(own_.tire().mesh()); }
  Result<Channels> drive(const FeTireDrive& drive,
                         bool states_pressure,
                         const Asked& asked) override;
  double rows_apart() const override {
    const fe_tire::Mesh& mesh = own_.tire().mesh();
    const double width =
        mesh.theta.size() > 1 ? mesh.theta[1] : 2.0 * std::numbers::pi / mesh.sectors;
    return width * mesh.outer_radius();
  }
  Result<std::vector<StandingFootprint>> footprints(const FootprintTest& test) override;
  Result<Channels> print(const FootprintTest& test, const Asked& asked) override;
  Result<Channels> steady(const formats::CsvTable& states,
                          const SteadyConditions& conditions) override;
  Result<Channels> steady_with_slopes(const formats::CsvTable& states,
                                      const SteadyConditions& conditions,
                                      const Asked& asked) override;
  Result<std::vector<std::string>> steady_in_blocks(
      const formats::CsvTable& states,
      const SteadyConditions& conditions,
      const std::function<void(const Channels&)>& tell) override;
  std::vector<std::string> limits_in(const formats::CsvTable& states,
                                     const SteadyConditions& conditions) override;
  /// Rolls in time (rigs/fe_rolling/slip_record.h). No derivatives are known.
  Result<Channels> slip_history(const formats::CsvTable& states,
                                const SlipHistoryConditions& conditions,
                                const Asked& asked,
                                std::vector<std::string>& remarks) override;
  Status history_in_blocks(const formats::CsvTable& states,
                           const SlipHistoryConditions& conditions,
                           const std::function<void(const Channels&)>& tell,
                           std::vector<std::string>& remarks) override;
  std::vector<std::string> limits_in_history(
      const formats::CsvTable& states, const SlipHistoryConditions& conditions) const override;
  /// Returns a tire in time (models/fe_tire/passage/fe_rolling_tire.h). It has a mesh of its own
  /// and needs the specimen no longer.
  std::unique_ptr<Tire> tire(const Inflation& pressure = {}) const override;
  std::vector<std::string> assumed_in_time() const override;
  std::optional<Felt> felt() const override;

 protected:
  /// Returns the tire on the mesh that a footprint needs.
  virtual SlopedTire& for_footprint(const FootprintTest&) { return own_; }
  /// Sets other numbers on the same mesh and keeps the symbolic work on it.
  void set(fe_tire::Materials materials, double pressure, Document numbers);
  /// States the rim, for tests in which it moves.
  void set_rim(std::optional<fe_tire::RimBody> rim);
  /// States the Prony terms of rubbers and cords, for tests that measure losses.
  void set_losses(fe_tire::LossMaterials losses);
  /// States the friction with the ground, for tests in which the tire rolls and that state none.
  void set_friction(std::optional<fe_tire::RollingFriction> friction);
  /// States the highest frequency, Hz, of a tire that is reduced in tests in time.
  void set_reduction(std::optional<double> highest);

 private:
  Result<StandingTire> standing(fe_tire::FeTire& tire, const FootprintTest& test) const;
  SlopedTire own_;
  double pressure_;
  std::optional<fe_tire::RimBody> rim_;
  fe_tire::LossMaterials losses_;
  std::optional<fe_tire::RollingFriction> friction_;
  std::optional<double> reduced_to_;
  Document numbers_;
  std::unique_ptr<TireRig> rig_;
};

/// True for tests with slopes in which the tire rolls steadily.
bool rolls(const Test& test);
/// Returns why slopes of this test are not known on a tire with these losses: in tests in which it
/// rolls, only an elastic tire on ground with friction knows them; empty if they may be known.
std::string why_without_rates(const fe_tire::LossMaterials& losses, const Test& test);

/// Returns why every run of this test fails on a finite-element tire with this mesh: sensor points
/// that are not on it, conventions that such a tire does not have; else "".
std::string why_every_run_fails(const fe_tire::Mesh& mesh, const Test& test);

}  // namespace latsch::experiment
