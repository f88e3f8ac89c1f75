// SPDX-License-Identifier: Apache-2.0
// Keys of a study file for which the form has fields; all others are in the text beside it. `latsch help study`
// explains each of them.

export interface Key {
  name: string;
  title: string;
  isNumber?: boolean;
  choices?: readonly string[];
  example?: string;
}

export interface Group {
  table: string;
  title: string;
  about: string;
  keys: readonly Key[];
}

export const kGroups: readonly Group[] = [
  {
    table: 'optimizer',
    title: 'Optimizer',
    about: 'where the search goes',
    keys: [
      { name: 'method', title: 'method', choices: ['auto', 'residual_trust_region', 'levenberg_marquardt', 'sqp', 'gss', 'gss_nlc', 'nelder_mead', 'genetic'] },
      { name: 'start', title: 'start', choices: ['values', 'journal', 'basins'] },
      { name: 'step_tolerance', title: 'step tolerance', isNumber: true, example: 'of the range, such as 0.001' },
      { name: 'max_steps', title: 'most trials', isNumber: true, example: 'such as 1000' },
    ],
  },
  {
    table: 'doe',
    title: 'Design of experiments',
    about: 'what “Design of experiments” runs',
    keys: [
      { name: 'design', title: 'design', choices: ['full_factorial', 'latin_hypercube', 'sobol', 'morris'] },
      { name: 'levels', title: 'levels', isNumber: true, example: 'of a full factorial, such as 5' },
      { name: 'points', title: 'points', isNumber: true, example: 'of the others, such as 40' },
    ],
  },
  {
    table: 'run',
    title: 'Run',
    about: 'changes no result',
    keys: [
      { name: 'workers', title: 'workers', isNumber: true, example: 'such as 2' },
      { name: 'timeout', title: 'timeout of a trial', example: 'such as 10 min' },
      { name: 'memory', title: 'memory of a worker', example: 'such as 4 GB' },
      { name: 'on_failure', title: 'after a failure', choices: ['proceed', 'abort', 'retry', 'recover', 'continuation'] },
    ],
  },
];
