// SPDX-License-Identifier: Apache-2.0
// The page of the server. The address that `latsch serve` prints holds its token, which the server changes for a cookie;
// what is left of it leaves the address bar.

import 'uplot/dist/uPlot.min.css';
import './app.css';

import { mount } from 'svelte';

import App from './App.svelte';

if (new URLSearchParams(location.search).has('token')) history.replaceState(null, '', location.pathname + location.hash);

mount(App, { target: document.getElementById('studio')! });
