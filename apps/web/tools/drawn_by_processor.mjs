// SPDX-License-Identifier: Apache-2.0
// uPlot requests the context of its canvas in a way that lets a browser draw on the graphics processor. The first
// drawing of a page then waits until every kind of mark has a program there, some hundred milliseconds if that
// processor is emulated by software. A few thousand rectangles and lines take the main processor less than ten
// milliseconds; the drawing is transferred as one picture.

const kAsked = 'can.getContext("2d")';
const kInstead = 'can.getContext("2d", { willReadFrequently: true })';

export function drawnByProcessor() {
  return {
    name: 'latsch-drawn-by-processor',
    enforce: 'pre',
    transform(code, id) {
      if (!id.endsWith('uPlot.esm.js')) return null;
      if (!code.includes(kAsked)) throw new Error(`${id} has no ${kAsked}: this version of uPlot asks for its context otherwise`);
      return { code: code.replace(kAsked, kInstead), map: null };
    },
  };
}
