// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// A pane that shows points in space: what it is called, and which array colours them.

/** The name of a pane of points that have the colours of this array. */
export function cloud_name(array: string): string {
  return `cloud(${array})`;
}

/** The array that colours them; undefined: the name of no such pane. */
export function cloud_color(name: string): string | undefined {
  return /^cloud\((\w+)\)$/.exec(name)?.[1];
}

/** The array whose values a pane shows. */
export function shown_array(name: string): string {
  return cloud_color(name) ?? name;
}
