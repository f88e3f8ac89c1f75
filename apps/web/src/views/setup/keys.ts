// SPDX-License-Identifier: Apache-2.0
// Keys of a study file for which the form has fields; all others are in the text beside it. The choices and the
// meaning of each key come from the program, which has them from the readers of a study (`latsch help study`).

export interface Key {
  name: string;
  title: string;
  isNumber?: boolean;
  /** Choices that need more than the form can write. */
  without?: readonly string[];
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
      { name: 'method', title: 'method', without: ['ensemble'] },
      { name: 'start', title: 'start' },
      { name: 'step_tolerance', title: 'step tolerance', isNumber: true, example: 'of the range, such as 0.001' },
      { name: 'max_steps', title: 'most trials', isNumber: true, example: 'such as 1000' },
    ],
  },
  {
    table: 'doe',
    title: 'Design of experiments',
    about: 'what “Design of experiments” runs',
    keys: [
      { name: 'design', title: 'design' },
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
      { name: 'on_failure', title: 'after a failure' },
    ],
  },
];
