// SPDX-License-Identifier: Apache-2.0
// The page of the server. The address that `latsch serve` prints contains its token, which the server replaces by a
// cookie; the token is then removed from the address bar.

import 'uplot/dist/uPlot.min.css';
import './app.css';

import { mount } from 'svelte';

import App from './App.svelte';

if (new URLSearchParams(location.search).has('token')) history.replaceState(null, '', location.pathname + location.hash);

mount(App, { target: document.getElementById('studio')! });
