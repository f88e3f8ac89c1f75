// SPDX-License-Identifier: Apache-2.0
// The answers of the server: the shapes of docs/studio.md, under their names. Numbers are in the unit named beside
// them, targets and errors are ratios, null is a value that is not known or not finite.

export type Value = number | null;
/** A number, or a text with its unit as the report words it: "22.3 N/mm^2", "9.8 .. 10.3 N/mm^2", "at least 4 bar". */
export type Told = Value | string | readonly Value[];
export type Scale = 'linear' | 'logarithmic';
export type StudyState = 'new' | 'running' | 'stopped' | 'ended' | 'reading' | 'broken';
export type Verb = 'run' | 'resume' | 'doe' | 'identify';

export interface HomeStudy {
  study: string;
  title: string;
  state: StudyState;
  trials: number;
  failed: number;
  foreign: number;
  best: Value;
  variables: number;
  changed: number;
  reading: boolean;
  error: string;
}

export interface Home {
  version: string;
  folder: string;
  has_page: boolean;
  loading: { done: number; total: number } | null;
  studies: HomeStudy[];
}

export interface Variable {
  name: string;
  path: string;
  unit: string;
  lower: Value;
  upper: Value;
  initial: Value;
  scale: Scale;
  best: Value;
}

export interface Experiment {
  name: string;
  kind: string;
  conditions: string;
  compared: string;
  fitted: boolean;
  weight: Value;
  values: number;
  share: Value;
}

export interface FailureGroup {
  reason: string;
  cause: string;
  count: number;
  trials: number[];
  hint: string;
}

export interface Run {
  workers: number;
  is_starting: boolean;
  exit_code: Value;
  was_stopped: boolean;
  log_file: string;
  elapsed: Value;
  rate: Value;
  eta: Value;
  is_ours: boolean;
  message: string;
  log: string[];
}

export interface Study {
  study: string;
  title: string;
  file: string;
  model: { file: string; kind: string };
  optimizer: { method: string; reason: string; ending: string; tests?: string[] }; // tests: those of the ending, with their numbers
  state: StudyState;
  error: string;
  has_design: boolean;
  workers: number;
  run: Run | null;
  trials: number;
  succeeded: number | null; // null: the journal is of another study
  failed: number | null;
  foreign: number; // run for another study, or for other measurements, weights or bounds
  best: { trial: number; target: Value; words: string; violation: Value; values: Value[]; shown: string[] } | null;
  initial: { trial: number; target: Value } | null;
  variables: Variable[];
  experiments: Experiment[];
  constraints: string[];
  failures: FailureGroup[];
  warnings: string[];
  ledgers?: Ledger[];
}

export interface LedgerRow {
  written: string;
  taken_as: string;
  meaning: string;
  unit_written: string;
  unit: string;
  factor: Value;
  axes: string;
  used_by: string[];
  state: string; // "used", "not used", "assumed", "?"
  remark: string;
}

export interface Ledger {
  file: string;
  summary: string;
  rows: LedgerRow[];
}

export interface Convergence {
  total: number;
  from: number;
  to: number;
  trial: number[];
  target: Value[];
  best: Value[];
  failed: number[];
  is_decimated: boolean;
}

export interface TrialRow {
  trial: number;
  target: Value;
  violation: Value;
  values: Value[];
  reason: string; // "" for a trial that succeeded
  cause: string;
  seconds: Value;
}

export interface Trials {
  total: number;
  rows: TrialRow[];
}

export interface TrialExperiment {
  name: string;
  fitted: boolean;
  weight: Value;
  value: Value;
  share: Value;
  measure: string; // "mean", "RMS": what `error` is
  error: Value;
  largest_error: Value;
}

export interface Trial extends TrialRow {
  hint: string;
  experiments: TrialExperiment[];
}

export interface XY {
  x: Value[];
  y: Value[];
}

/** Samples that belong together: the simulated line, with the measured points. Pieces of a level share a color. */
export interface Piece extends XY {
  name: string; // "Fz 1050 N, gamma 2 deg"
  level: string; // "Fz 1050 N"
  measured: XY;
}

export interface Curve {
  experiment: string;
  conditions: string;
  fitted: boolean;
  x_name: string;
  x_unit: string;
  y_name: string;
  y_unit: string;
  x: Value[];
  measured: Value[];
  simulated: XY;
  initial: XY | null;
  pieces?: Piece[] | null; // null or absent: one line
  errors: Value[];
  errors_x?: Value[]; // same as x if absent
  band: { x: Value[]; lower: Value[]; upper: Value[]; inside: Told } | null;
  psd: { unit: string; measured: XY; simulated: XY } | null;
}

export interface ModePair {
  label: string;
  measured: Value;
  simulated: Value;
  initial: Value;
  error: Value;
  likeness: Value;
}

export interface LooseMode {
  label: string;
  frequency: Value;
}

export interface ModeSet {
  experiment: string;
  conditions: string;
  fitted: boolean;
  pairs: ModePair[];
  missing: LooseMode[];
  extra: LooseMode[];
}

export interface ComparedValue {
  name: string;
  compared: string;
  unit: string;
  fitted: boolean;
  weight: Value;
  measured: Value;
  found: Value;
  initial: Value;
  lower: Value;
  upper: Value;
  error: Value;
}

export interface Comparison {
  trial: number;
  initial: number | null;
  curves: Curve[];
  modes: ModeSet[];
  values: ComparedValue[];
  absent: { experiment: string; reason: string }[];
  no_bands?: string; // reason if there are none
}

export interface Limits {
  trial: number;
  limits: string[]; // ranges of a tire's file that are left, a tire off the road, each with its tests
}

export interface SurfaceAxis {
  name: string;
  unit: string;
  scale: Scale;
  levels: number[];
}

export interface Surface {
  x: SurfaceAxis;
  y: SurfaceAxis;
  target: Value[][];
  held: string;
  found: [Value, Value] | null;
  initial: [Value, Value] | null;
}

export interface Slice {
  variable: string;
  unit: string;
  scale: Scale;
  x: Value[];
  target: Value[];
  found: Value;
}

export interface Minima {
  design: string;
  variables: string[];
  count: number;
  rows: { target: Value; points: number; values: Told[] }[];
  doubt: string;
}

export interface Target {
  surfaces: Surface[];
  slices: Slice[];
  minima: Minima | null;
  effects: { variable: string; mu_star: Value; mu: Value; sigma: Value }[];
  scatter: { trial: number[]; target: Value[]; values: Value[][] };
}

export interface KpiRow {
  name: string;
  experiment: string;
  unit: string;
  weight: Value;
  target: Value;
  initial: Value;
  optimized: Value;
  error: Value;
  fitted: boolean;
  flag: string;
}

export interface Kpis {
  rows: KpiRow[];
  variables: {
    name: string;
    unit: string;
    initial: Value;
    optimized: Value;
    lower: Value;
    upper: Value;
    interval: Told;
    interval_from?: string; // "data", "data and a bound", "bounds" or "not known" sets its ends
    flag: string;
  }[];
  target: { initial: Value; optimized: Value };
}

export interface Profile {
  variable: string;
  unit: string;
  scale: Scale;
  x: Value[];
  rise: Value[];
  found: Value;
  verdict: string;
  interval: Told;
}

/** A variable of the posterior's samples. */
export interface SampledVariable {
  name: string;
  unit: string;
  scale: Scale;
  found: Value;
  median: Value;
  interval: [Value, Value];
  linear: [Value, Value]; // null: an open end, or one beyond the bound
  distance: Value; // deviations by which the ends differ from those of the linear interval
  shape: string;
  rhat: Value;
  effective: Value;
  draws: Value[]; // empty if others differ more from their linear intervals
}

/** 95 % bands of an experiment's computed values, linear and from samples; all but x as differences from `center`. */
export interface SampledBand {
  experiment: string;
  title: string; // the experiment and what is subtracted
  unit: string;
  x_name: string;
  x_unit: string;
  x: Value[];
  names: string[];
  center: Value[];
  measured: Value[];
  linear_lower: Value[];
  linear_upper: Value[];
  lower: Value[];
  upper: Value[];
  values: number; // number of values; long curves are thinned
}

export interface Posterior {
  verdict: 'stands' | 'doubtful' | 'refused' | 'unchecked' | 'model'; // model: it decided on the samples itself
  mixed: boolean;
  words: string;
  remarks: string[];
  samples: number;
  trials: number;
  failed: number;
  variables: SampledVariable[];
  bands: SampledBand[]; // empty where the samples are not those of the model
}

export interface Identifiability {
  known: boolean;
  why_not: string | null;
  variables: { name: string; value: Told; interval: Told; interval_from?: string; shift: Told }[];
  deviations: Value[];
  directions: string[];
  correlation: Value[][];
  profiles: Profile[];
  bands: { experiment: string; fitted: boolean; widest: Told; inside: Told; remarks: string[] }[];
  gains: { measurement: string; shrinkage: Value; helps: string }[];
  left_out: { name: string; fitted: Value; predicted: Value }[];
  remarks: string[];
  missed: string[];
  residuals: Value;
  priors: Value;
  posterior: Posterior | null; // samples that were drawn around the fit
}

export interface ModelNumber {
  path: string;
  value: Value;
  unit: string;
  line: number | null;
  variable: string; // "" if it does not vary
}

export interface Outline {
  part: string;
  y: Value[];
  z: Value[];
}

export interface Model {
  file: string;
  kind: string;
  description: string | string[];
  numbers: ModelNumber[];
  has_scene: boolean;
}

export interface Section {
  title: string;
  unit: string;
  polygons: Outline[];
  cords: Outline[];
}

/** Keys of the tables of a study, as their readers declare them: by table, then by key. */
export type KeysOfTables = Record<string, Record<string, { sentence: string; choices: string[] }>>;

export interface StudyFile {
  text: string;
  version: string;
}

export interface CheckMessage {
  text: string;
  line: number | null;
  is_wrong: boolean; // false: a remark
}

export interface Check {
  ok: boolean;
  messages: CheckMessage[];
  understood: string[];
}

export interface Edit {
  table: string[];
  key: string;
  value: number | string | boolean | null;
}

export interface Compared {
  studies: { study: string; title: string; target: Value; no_intervals: string }[]; // reason if there are none
  variables: { name: string; unit: string; values: Value[]; intervals: Told[]; missing: string[] }[]; // reason if there
                                                                                                      // is no value
  experiments: { name: string; errors: Value[]; missing: string[] }[];
  convergence: { trial: number[]; best: Value[] }[];
}

export interface TrialEvent {
  study: string;
  total: number;
  best: { trial: number; target: Value } | null;
  is_many: boolean; // several events at once: the details must be requested
  rows: { trial: number; target: Value }[];
}

export interface RunEvent {
  study: string;
  state: StudyState;
  message: string;
}
