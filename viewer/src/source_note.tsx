// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// What is another here than with a scene that is computed: frames that were made before, and a page that is a file.

import { useSignal } from "@preact/signals";
import { copy } from "./download";
import { brought_back } from "./keep";
import type { Absent } from "./protocol";
import { hello } from "./store";

function Live({ command }: { command: string }) {
  const copied = useSignal(false);
  return <><code>{command}</code> <button type="button" class="quiet" onClick={() => void copy(command).then((done) => (copied.value = done))}>{copied.value ? "Copied" : "Copy"}</button></>;
}

function by_reason(absent: readonly Absent[]): [string, Absent[]][] {
  const all = new Map<string, Absent[]>();
  for (const one of absent) all.set(one.why, [...(all.get(one.why) ?? []), one]);
  return [...all];
}

export function SourceNote() {
  const of = hello.value;
  const open = useSignal(true);
  if (of === undefined || !open.value) return null;
  const absent = of.absent ?? [];
  const close = <button type="button" onClick={() => (open.value = false)} aria-label="Close: what this page is">Close</button>;
  if (of.live !== undefined) {
    const count = of.frames ?? 0;
    return (
      <aside class="notice" aria-label="What this page is" data-note="file">
        <strong>A file with {count === 1 ? "one frame" : `${count} frames`}.</strong> Everything can be looked at; keys are shown, and not changed, for nothing computes behind it. Live: <Live command={of.live} /> {close}
      </aside>
    );
  }
  if (of.source === undefined) return null;
  return (
    <aside class="notice" aria-label="What this page is" data-note="files">
      <strong>Frames that were made before.</strong>{" "}
      {of.source.raw === true ? "Their raw frames are decoded here: keys of decoding change what is seen, those of scene and sensor cannot." : "They are shown as they are: no key changes them."}{" "}
      {absent.length > 0 && (
        <details>
          <summary>{absent.length === 1 ? "One pane is" : `${absent.length} panes are`} not there</summary>
          <ul>{by_reason(absent).map(([why, all]) => <li key={why} data-absent={all.map((one) => one.array).join(" ")}><strong>{all.map((one) => one.title).join(", ")}</strong>: {why}</li>)}</ul>
        </details>
      )}{" "}
      {close}
    </aside>
  );
}

/** What a picture brought back. */
export function BroughtBack() {
  if (brought_back.value === undefined) return null;
  return <div class="notice" role="status" data-note="restored">{brought_back.value} <button type="button" onClick={() => (brought_back.value = undefined)}>Close</button></div>;
}
