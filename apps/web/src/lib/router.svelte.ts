// SPDX-License-Identifier: Apache-2.0
// The address of the displayed view, behind the #: "#/convergence?study=tire/study.toml&weights=force:2". Every view
// has one.

export interface Route {
  view: string;
  parameters: Record<string, string>;
}

function parse(hash: string): Route {
  const [path = '', query = ''] = hash.replace(/^#\/?/, '').split('?');
  return { view: path || 'home', parameters: Object.fromEntries(new URLSearchParams(query)) };
}

export function address(view: string, parameters: Record<string, string | number | undefined> = {}): string {
  const words = Object.entries(parameters)
    .filter(([, value]) => value !== undefined && value !== '')
    .map(([key, value]) => `${key}=${encodeURIComponent(String(value)).replaceAll('%2F', '/').replaceAll('%3A', ':').replaceAll('%2C', ',')}`)
    .join('&');
  return `#/${view}${words ? `?${words}` : ''}`;
}

class Router {
  route = $state.raw<Route>(parse(location.hash));

  constructor() {
    addEventListener('hashchange', () => {
      this.route = parse(location.hash);
    });
  }

  get study(): string {
    return this.route.parameters.study ?? '';
  }

  get weights(): string {
    return this.route.parameters.weights ?? '';
  }

  /** The address of another view of the same study, with the same weights. */
  view(view: string, parameters: Record<string, string | number | undefined> = {}): string {
    return address(view, { study: this.study, weights: this.weights, ...parameters });
  }

  /** Changes parameters of this view's address; adds a step to the browser's history only if `isStep`. */
  set(parameters: Record<string, string | number | undefined>, isStep = false): void {
    const next = address(this.route.view, { ...this.route.parameters, ...parameters });
    if (next === location.hash) return;
    if (isStep) location.hash = next;
    else history.replaceState(null, '', next);
    this.route = parse(next);
  }
}

export const router = new Router();
