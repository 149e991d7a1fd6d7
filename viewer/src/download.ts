// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// What leaves the page: files that the browser saves, and texts that it copies.

import { fault, frame, hello, spoken } from "./store";

/** Letters, digits and what file names have between them anywhere. */
function safe(text: string): string {
  return text.replace(/[^\p{L}\p{N}._-]+/gu, "_").replace(/^[._]+/, "").slice(0, 100);
}

/** SCENE_0003_WHAT.END, of the frame that is drawn or another one. */
export function file_name(what: string, end: string, of = frame.peek()?.frame): string {
  const number = of === undefined ? "" : `_${String(of).padStart(4, "0")}`;
  const scene = safe((hello.peek()?.scene ?? "").split("/").at(-1)?.replace(/\.ya?ml$/, "") ?? "");
  return `${scene === "" ? "tofray" : scene}${number}${what === "" ? "" : `_${safe(what)}`}.${end}`;
}

/** @return  whether the browser let it; a page that another one holds may not copy, which is told */
export async function copy(text: string): Promise<boolean> {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    fault.value = { type: "fault", id: null, text: "This browser does not let the page copy.", more: text.length < 2000 ? `To be marked and copied by hand: ${text}` : "" };
    return false;
  }
}

export function offer(name: string, contents: BlobPart, type: string): void {
  const address = URL.createObjectURL(contents instanceof Blob ? contents : new Blob([contents], { type }));
  const link_to = document.createElement("a");
  link_to.href = address;
  link_to.download = name;
  link_to.click();
  spoken.value = `${name} is saved`;
  setTimeout(() => URL.revokeObjectURL(address), 10_000);
}
