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
