// SPDX-License-Identifier: Apache-2.0
// The finite-element tire as a specimen, wherever its mesh is from.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "experiment/language/capabilities.h"
#include "experiment/language/specimen.h"
#include "experiment/rigs/fe_tire/tire_footprint.h"
#include "experiment/rigs/fe_tire/tire_rig.h"
#include "experiment/rigs/static_stiffness.h"
#include "models/fe_tire/analysis/fe_tire.h"
#include "models/fe_tire/slopes/tire_slopes.h"

namespace latsch::experiment {

/// A tire with its slopes, which are made once for all tests of a trial.
class SlopedTire {
 public:
  /// What a file of such numbers describes, on this mesh.
  using Varied = std::function<fe_tire::VariedTire(const Document&)>;

  SlopedTire(fe_tire::FeTire tire, Varied varied)
      : tire_(std::make_unique<fe_tire::FeTire>(std::move(tire))), varied_(std::move(varied)) {}

  fe_tire::FeTire& tire() const { return *tire_; }
  /// The same mesh with other numbers: the symbolic work on it is kept.
  void set(fe_tire::Materials materials);
  Result<fe_tire::TireSlopes*> slopes_in(const std::vector<std::string>& paths,
                                         const Document& numbers);

 private:
  std::unique_ptr<fe_tire::FeTire> tire_;  // its slopes refer to it
  Varied varied_;
  std::vector<std::string> paths_;  // of slopes_
  std::unique_ptr<fe_tire::TireSlopes> slopes_;
};

class FeTireSpecimen : public Specimen,
                       public IsPressed,
                       public Vibrates,
                       public StandsOnGround,
                       public IsInflated,
                       public IsWeighed,
                       public HasFootprint,
                       public TakesConditions {
 public:
  using Varied = SlopedTire::Varied;

  /// `pressure`, Pa: of tests that state none.
  FeTireSpecimen(fe_tire::FeTire tire, double pressure, Document numbers, Varied varied);

  Result<Channels> press(const LoadDeflection& test, const Asked& asked) override;
  Result<Channels> vibrate(const ModalTest& test, const Asked& asked) override;
  Eigen::Matrix3Xd sensor_points() const override { return default_points(own_.tire().mesh()); }
  Result<Channels> stand(const StandingTest& test, const Asked& asked) override;
  Result<Channels> inflate(const InflatedSizeTest& test, const Asked& asked) override;
  Result<Channels> weigh(const MassTest& test, const Asked& asked) override;
  Result<std::vector<StandingFootprint>> footprints(const FootprintTest& test) override;
  Result<Channels> print(const FootprintTest& test, const Asked& asked) override;

 protected:
  /// The tire on the mesh that a footprint asks for.
  virtual SlopedTire& for_footprint(const FootprintTest&) { return own_; }
  /// The same mesh with other numbers: the symbolic work on it is kept.
  void set(fe_tire::Materials materials, double pressure, Document numbers);

 private:
  Result<StandingTire> standing(fe_tire::FeTire& tire, const FootprintTest& test) const;
  template <class Test>
  Result<Channels> run(const Test& test, const Asked& asked);

  SlopedTire own_;
  double pressure_;
  Document numbers_;
  std::unique_ptr<TireRig> rig_;
};

/// What to mind where a modal test asks for points that are not on this mesh; empty: nothing.
std::string far_points(const fe_tire::Mesh& mesh, const Test& test);

}  // namespace latsch::experiment
