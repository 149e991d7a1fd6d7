// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// What keys and buttons do alike.

import { computed, signal } from "@preact/signals";
import { copy } from "./download";
import { close_other, open_other } from "./edit";
import { edited, flipped, hello, other, state, tab } from "./store";

/** What makes these very files by the command line: of the state that is edited. */
export const command = computed(() => (edited.value === "b" ? other.value?.command : state.value?.command) ?? hello.value?.command ?? "");

export const copied = signal(false);

export async function copy_command(): Promise<void> {
  if (command.value === "") return;
  if (!await copy(command.value)) return;
  copied.value = true;
  setTimeout(() => (copied.value = false), 2000);
}

/** Into the field of the search, with the controls where they are no longer to be seen. */
export function find_control(): void {
  tab.value = "controls";
  requestAnimationFrame(() => document.querySelector<HTMLInputElement>("#search")?.select());
}

/** B begins as a copy of A. */
export function toggle_other(): void {
  const of = state.value;
  flipped.value = false;
  if (other.value !== undefined) return close_other();
  if (of === undefined) return;
  open_other(of.overrides, of.seed);
  edited.value = "b";   // what is changed next makes the difference
}
