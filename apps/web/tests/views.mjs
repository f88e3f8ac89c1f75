// SPDX-License-Identifier: Apache-2.0
// The views and their addresses, for tests of all of them.

export const kViews = [
  ['home', '#/home'],
  ['study', '#/study?study=tire_b_twin/study.toml'],
  ['study_new', '#/study?study=fresh/study.toml'],
  ['trial', '#/study?study=tire_b_twin/study.toml&open=12'],
  ['convergence', '#/convergence?study=tire_b_twin/study.toml'],
  ['target', '#/target?study=tire_b_twin/study.toml'],
  ['comparison', '#/comparison?study=tire_b_twin/study.toml'],
  ['kpis', '#/kpis?study=tire_b_twin/study.toml'],
  ['kpis_tried', '#/kpis?study=tire_b_twin/study.toml&weights=stiffness:3'],
  ['identifiability', '#/identifiability?study=tire_b_twin/study.toml'],
  ['identifiability_new', '#/identifiability?study=fresh/study.toml'],
  ['model', '#/model?study=tire_b_twin/study.toml'],
  ['model_rig', '#/model?study=compliance/study.toml'],
  ['setup', '#/setup?study=tire_b_twin/study.toml'],
  ['compare', '#/compare?study=tire_b_twin/study.toml&other=compliance/study.toml'],
  ['missing', '#/study?study=gone/study.toml'],
];
