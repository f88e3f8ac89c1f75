// SPDX-License-Identifier: Apache-2.0
// The chapters of a report beside its views, which are seen without scripts and on paper. An address that names one of
// them shows them all, under their own style sheet; any other address shows the views.

import { isReport } from './answers';

const kPrinted = 'printed';

export const printedAddress = `#${kPrinted}`;

function show(): void {
  const name = decodeURIComponent(location.hash.slice(1));
  const printed = document.getElementById(kPrinted);
  const studio = document.getElementById('studio');
  if (!printed || !studio) return;
  const isPrinted = name === kPrinted || (name !== '' && !name.startsWith('/') && printed.querySelector(`[id="${CSS.escape(name)}"]`) !== null);
  printed.hidden = !isPrinted;
  studio.hidden = isPrinted;
  styleSheet('printed-style', isPrinted ? 'all' : 'print');
  styleSheet('studio-style', isPrinted ? 'not all' : 'screen');
}

function styleSheet(id: string, media: string): void {
  (document.getElementById(id) as HTMLStyleElement | null)?.setAttribute('media', media);
}

/** Prints the chapters, whatever is on the screen. */
function print(isPrinting: boolean): void {
  if (isPrinting) {
    document.getElementById(kPrinted)!.hidden = false;
    document.getElementById('studio')!.hidden = true;
  } else {
    show();
  }
}

export function beginPrinted(): void {
  if (!isReport) return;
  addEventListener('hashchange', show);
  addEventListener('beforeprint', () => print(true));
  addEventListener('afterprint', () => print(false));
  show();
}
