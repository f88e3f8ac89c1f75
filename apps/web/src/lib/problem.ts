// SPDX-License-Identifier: Apache-2.0
// An error of a request as shown to the user: what and where, why, what to do next.

export class Problem extends Error {
  constructor(
    message: string,
    readonly hint: string,
    readonly where: string,
    readonly status = 0,
  ) {
    super(message);
  }
}

export function asProblem(error: unknown, where: string): Problem {
  if (error instanceof Problem) return error;
  const words = error instanceof Error ? error.message : String(error);
  return new Problem(words, 'Reload the page; the journal holds all that has been computed.', where);
}

const kHints: Record<number, string> = {
  401: 'Open the address that `latsch serve` has printed: it holds the token of this server.',
  403: 'Open the address that `latsch serve` has printed: it holds the token of this server.',
  404: 'Go to the list of studies: the file may have been moved or removed.',
  409: 'The file has changed meanwhile: read it anew, then change it again.',
};

export async function problemOf(response: Response, where: string): Promise<Problem> {
  let words = `the server answered ${response.status} ${response.statusText}`;
  // An error in a study says itself what to do; the terminal of the server has the details of an error in the server.
  let hint = kHints[response.status] ?? (response.status < 500 ? '' : 'Look at the terminal in which `latsch serve` runs.');
  try {
    const body = (await response.json()) as { error?: string; hint?: string };
    if (body.error) words = body.error;
    if (body.hint) hint = body.hint;
  } catch {
    // For an answer that is no JSON only the status is known.
  }
  return new Problem(words, hint, where, response.status);
}
