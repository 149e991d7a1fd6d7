// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// The text that a PNG has with it under a keyword. The file may be anybody's.

const signature = [0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a];
const longest = 48_000;   // what fits into a message

/** @throws RangeError where it is no PNG, or has no such text */
export function text_of_png(file: ArrayBuffer, keyword: string): string {
  const bytes = new Uint8Array(file);
  const view = new DataView(file);
  if (bytes.length < 8 || signature.some((one, i) => bytes[i] !== one)) throw new RangeError("it is no PNG");
  for (let at = 8; at + 12 <= bytes.length;) {
    const length = view.getUint32(at);
    const type = String.fromCharCode(...bytes.subarray(at + 4, at + 8));
    if (at + 12 + length > bytes.length) throw new RangeError("it ends within a part");
    const text = type === "iTXt" || type === "tEXt" ? text_of_part(type, bytes.subarray(at + 8, at + 8 + length), keyword) : undefined;
    if (text !== undefined) return text;
    if (type === "IEND") break;
    at += 12 + length;
  }
  throw new RangeError("it has no state of tofray in it: programs that change a picture take it out");
}

function text_of_part(type: string, part: Uint8Array, keyword: string): string | undefined {
  const end = part.indexOf(0);
  if (end < 0 || String.fromCharCode(...part.subarray(0, Math.min(end, 80))) !== keyword) return undefined;
  let from = end + 1;
  if (type === "iTXt") {
    if (part[from] !== 0) throw new RangeError("its text is compressed");
    const language = part.indexOf(0, from + 2);
    const translated = language < 0 ? -1 : part.indexOf(0, language + 1);
    if (translated < 0) throw new RangeError("its text cannot be read");
    from = translated + 1;
  }
  if (part.length - from > longest) throw new RangeError(`its text has ${part.length - from} bytes, and ${longest} are the most`);
  return new TextDecoder("utf-8", { fatal: true }).decode(part.subarray(from));
}
