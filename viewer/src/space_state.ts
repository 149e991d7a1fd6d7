// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Which panes show points in space, and what they showed before.

import { cloud_color, cloud_name } from "./cloud";
import { raw_view } from "./raw";
import { show, shown, temporal_titles } from "./store";

const before = new Map<number, string>();

/** Coloured by what the pane shows. */
export function show_space(pane: number, color?: string): void {
  const now = shown.peek()[pane];
  if (now === undefined) return;
  if (cloud_color(now) === undefined) before.set(pane, now);
  const own = cloud_color(now) === undefined && raw_view(now) === undefined && !(now in temporal_titles) ? now : "z_m";
  show(pane, cloud_name(color ?? own));
}

/** The pane had the focus: what comes in its place gets it. */
function keep_focus(pane: number): void {
  if (document.activeElement?.closest(".stage") === null) return;
  requestAnimationFrame(() => requestAnimationFrame(() => document.querySelectorAll(".pane")[pane]?.querySelector<HTMLElement>(".stage")?.focus()));
}

export function toggle_space(pane: number): void {
  const now = shown.peek()[pane];
  keep_focus(pane);
  if (now === undefined || cloud_color(now) === undefined) show_space(pane);
  else show(pane, before.get(pane) ?? cloud_color(now) ?? "z_m");
}
