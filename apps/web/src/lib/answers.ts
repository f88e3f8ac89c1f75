// SPDX-License-Identifier: Apache-2.0
// The answers of a report, which are in its page as an object from requests to answers:
//
//   <script type="application/json" id="answers">{"study": {...}, "trial?trial=12": {...}}</script>
//
// A request is its path without /api/ and its parameters in the order of docs/studio.md, without the study. A request
// with parameters that the page does not hold is answered by the path alone. A scene is {"gzip_base64": "..."}.

type Answers = Record<string, unknown>;

function read(): Answers | null {
  const element = document.getElementById('answers');
  return element?.textContent ? (JSON.parse(element.textContent) as Answers) : null;
}

const held = read();

export const isReport = held !== null;

export function heldAnswer(path: string, query: Record<string, unknown>): unknown {
  if (!held) return undefined;
  const words = Object.entries(query)
    .filter(([key, value]) => key !== 'study' && value !== undefined)
    .map(([key, value]) => `${key}=${String(value)}`)
    .join('&');
  return held[words ? `${path}?${words}` : path] ?? held[path];
}

export async function bytesOf(gzipped: string): Promise<ArrayBuffer> {
  const text = atob(gzipped);
  const bytes = new Uint8Array(text.length);
  for (let k = 0; k < text.length; ++k) bytes[k] = text.charCodeAt(k);
  const unpacked = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('gzip'));
  return new Response(unpacked).arrayBuffer();
}
