// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Finds keys by the beginnings of their words: "f num" finds camera.lens.f_number.

import type { Row } from "./protocol";

const separators = /[\s._,/-]+/;

function words_of(text: string): string[] {
  return text.toLowerCase().split(separators).filter((word) => word !== "");
}

/** How well one word is found: 0 is best; undefined, not at all. */
function grade(word: string, key_words: readonly string[], said: readonly string[]): number | undefined {
  if (key_words.includes(word)) return 0;
  if (key_words.some((one) => one.startsWith(word))) return 1;
  if (key_words.some((one) => one.includes(word))) return 3;
  return said.some((one) => one.startsWith(word)) ? 6 : undefined;
}

/** The rows that have every word, in their keys or at least in what is said of them; the best first. */
export function found(rows: readonly Row[], text: string): Row[] {
  const wanted = words_of(text);
  if (wanted.length === 0) return [];
  const graded: { row: Row; mark: number }[] = [];
  for (const row of rows) {
    const key_words = words_of(row.key);
    const said = words_of(`${row.label ?? ""} ${row.what ?? ""}`);
    let mark = key_words.length / 100;   // of two that are alike, the one that is nearer to the root
    for (const word of wanted) mark += grade(word, key_words, said) ?? Infinity;
    if (mark < Infinity) graded.push({ row, mark });
  }
  return graded.sort((a, b) => a.mark - b.mark).map((one) => one.row);
}

/** How many letters are to be typed, left out, changed or exchanged with their neighbour to make one word of the other. */
function letters_apart(a: string, b: string): number {
  let [before, last]: number[][] = [[], Array.from({ length: b.length + 1 }, (_, j) => j)];
  for (let i = 1; i <= a.length; ++i) {
    const now = [i];
    for (let j = 1; j <= b.length; ++j) {
      let least = Math.min(last![j]! + 1, now[j - 1]! + 1, last![j - 1]! + (a[i - 1] === b[j - 1] ? 0 : 1));
      if (i > 1 && j > 1 && a[i - 1] === b[j - 2] && a[i - 2] === b[j - 1]) least = Math.min(least, before![j - 2]! + 1);
      now.push(least);
    }
    [before, last] = [last!, now];
  }
  return last![b.length]!;
}

/** The search that may have been meant where nothing is found: each word that begins none of the keys' words gives way to the nearest of them, which is
 *  some letters apart, a third of them at most. undefined where there is none, or where nothing would be found by it, either. */
export function meant(rows: readonly Row[], text: string): string | undefined {
  const known = [...new Set(rows.flatMap((row) => words_of(row.key)))];
  const words = words_of(text).map((word) => {
    if (known.some((one) => one.startsWith(word))) return word;
    let [nearest, least] = ["", Math.floor(word.length / 3) + 1];
    for (const one of known) {
      const apart = letters_apart(word, one);
      if (apart < least) [nearest, least] = [one, apart];
    }
    return nearest === "" ? word : nearest;
  });
  const other = words.join(" ");
  return found(rows, other).length > 0 && found(rows, text).length === 0 ? other : undefined;
}
