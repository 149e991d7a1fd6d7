// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Which panes show raw frames, and what they showed before.

import { raw_name, raw_view, type RawKind } from "./raw";
import { show, shown } from "./store";

const before = new Map<number, string>();
let last_kind: RawKind = "raw";

export function show_raw(pane: number, kind: RawKind, number?: number): void {
  const now = shown.peek()[pane];
  if (now !== undefined && raw_view(now) === undefined) before.set(pane, now);
  last_kind = kind;
  show(pane, raw_name(kind, number));
}

/** The picture that had the focus is gone: what came in its place gets it. */
function keep_focus(pane: number): void {
  if (document.activeElement?.closest(".stage") === null) return;
  requestAnimationFrame(() => requestAnimationFrame(() => document.querySelectorAll(".pane")[pane]?.querySelector<HTMLElement>(".stage")?.focus()));
}

export function enlarge(pane: number, kind: RawKind, number: number): void {
  keep_focus(pane);
  show_raw(pane, kind, number);
}

/** All raw frames; from one of them back to all, from all to what was there. */
export function toggle_sheet(pane: number): void {
  const now = raw_view(shown.peek()[pane] ?? "");
  keep_focus(pane);
  if (now === undefined) return show_raw(pane, last_kind);
  if (now.number !== undefined) return show_raw(pane, now.kind);
  show(pane, before.get(pane) ?? "z_m");
}

export function last_raw_kind(): RawKind {
  return last_kind;
}
