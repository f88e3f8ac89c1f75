// SPDX-License-Identifier: Apache-2.0
// The views of a study, in the order of the work. All except the first are loaded when they are first shown.

import type { Component } from 'svelte';

import type { OpenStudy } from './study.svelte';

export interface View {
  name: string;
  title: string;
  load: () => Promise<{ default: Component<{ open: OpenStudy }> }>;
  needsServer?: boolean;
  asks?: string; // its first request to the server, for the study with its weights
}

export const views: readonly View[] = [
  { name: 'study', title: 'Overview', load: () => import('../views/StudyView.svelte') },
  { name: 'setup', title: 'Set-up', load: () => import('../views/setup/SetupView.svelte'), needsServer: true },
  { name: 'model', title: 'Model', load: () => import('../views/model/ModelView.svelte') },
  { name: 'convergence', asks: 'convergence', title: 'Convergence', load: () => import('../views/ConvergenceView.svelte') },
  { name: 'target', asks: 'target', title: 'Target function', load: () => import('../views/target/TargetView.svelte') },
  { name: 'comparison', title: 'Measured and simulated', load: () => import('../views/comparison/ComparisonView.svelte') },
  { name: 'kpis', asks: 'kpis', title: 'KPI table', load: () => import('../views/KpiView.svelte') },
  { name: 'identifiability', title: 'Identifiability', load: () => import('../views/identifiability/IdentifiabilityView.svelte') },
];
