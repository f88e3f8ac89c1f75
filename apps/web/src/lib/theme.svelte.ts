// SPDX-License-Identifier: Apache-2.0
// Light, dark, or the system's choice, stored in this browser. `version` counts changes, for drawings on a canvas that
// have to be drawn again.

export type Choice = 'system' | 'light' | 'dark';

const kKey = 'latsch-theme';
const system = matchMedia('(prefers-color-scheme: dark)');

function stored(): Choice {
  try {
    const choice = localStorage.getItem(kKey);
    return choice === 'light' || choice === 'dark' ? choice : 'system';
  } catch {
    return 'system'; // the browser stores nothing
  }
}

class Theme {
  choice = $state<Choice>(stored());
  version = $state(0);

  constructor() {
    this.#apply();
    system.addEventListener('change', () => this.#apply());
  }

  set(choice: Choice): void {
    this.choice = choice;
    try {
      localStorage.setItem(kKey, choice);
    } catch {
      // The choice is kept as long as the page is open.
    }
    this.#apply();
  }

  #apply(): void {
    const isDark = this.choice === 'dark' || (this.choice === 'system' && system.matches);
    document.documentElement.dataset.theme = isDark ? 'dark' : 'light';
    this.version += 1;
  }
}

export const theme = new Theme();

/** The value of a color of app.css, such as "--found". */
export function color(name: string): string {
  return name.startsWith('--') ? getComputedStyle(document.documentElement).getPropertyValue(name).trim() : name;
}
