// SPDX-License-Identifier: Apache-2.0
// The page as a report: one script for a file that contains the answers of all views (answers.ts) and <div
// id="studio"></div>.

import 'uplot/dist/uPlot.min.css';
import './app.css';

import { mount } from 'svelte';

import App from './App.svelte';
import { beginPrinted } from './lib/printed';

beginPrinted();
mount(App, { target: document.getElementById('studio')! });
