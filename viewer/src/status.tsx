// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
import { command, copied, copy_command } from "./actions";
import { retry_now } from "./connection";
import { save } from "./edit";
import { restored, undo } from "./history";
import { keep_open } from "./keep";
import { cannot, drawn_rate, edited, fault, frame, hello, link, other, state, stats, type Link } from "./store";

function word(of: Link): string {
  if (TOFRAY_IN_FILE && of === "open") return state.value?.playing === true ? "file, playing" : "file, paused";
  if (of === "open") return hello.value === undefined ? "connecting" : state.value?.playing !== true ? "paused" : hello.value.source === undefined ? "live" : "playing";
  return { keyless: "no key", connecting: "connecting", lost: "lost", gone: "no server", other: "other server", empty: "empty" }[of];
}

export function Status() {
  const figures = stats.value;
  const ms = frame.value?.compute_ms ?? 0;
  return (
    <div class="status">
      <span class={`light ${link.value === "open" ? "good" : "bad"}`} aria-hidden="true" />
      <span role="status">{word(link.value)}</span>
      {link.value === "open" && figures !== undefined && (
        <span class="faint figures" title={`${figures.computed} frames computed, ${figures.sent} sent, ${figures.dropped} passed over`}>
          {figures.fps.toFixed(figures.fps < 10 ? 1 : 0)} computed/s · {drawn_rate.value} drawn/s · {ms < 100 ? ms.toPrecision(2) : ms.toFixed(0)} ms
        </span>
      )}
    </div>
  );
}

function Trouble({ title, children }: { title: string; children: preact.ComponentChildren }) {
  return <div class="trouble" role="alert"><strong>{title}</strong> <span>{children}</span></div>;
}

/** What is wrong, and the way out. The pictures stay: they are the last ones. */
export function Troubles() {
  const of = link.value;
  const again = <button type="button" onClick={retry_now}>Try now</button>;
  return (
    <>
      {of === "lost" && <Trouble title="The connection is lost.">It is being opened again. {again}</Trouble>}
      {of === "gone" && (
        <Trouble title="The server is gone.">
          Nothing answers at {location.host}; still trying. <code>tofray view</code>, started again, prints a new address: open that one, its key is another. {again}
        </Trouble>
      )}
      {of === "other" && (
        <Trouble title="This address is an old one.">
          A <code>tofray view</code> answers at {location.host}, but the key of this tab does not open it. Open the address that it printed.
        </Trouble>
      )}
      {of === "keyless" && (
        <Trouble title="The address has no key.">
          <code>tofray view</code> prints an address that ends in <code>#t=…</code>: open that one, whole.
        </Trouble>
      )}
      {fault.value !== undefined && (
        <div class="trouble" role="alert">
          <strong>{fault.value.text}</strong> <span>{fault.value.more ?? ""}</span>{" "}
          <button type="button" onClick={() => (fault.value = undefined)}>Dismiss</button>
        </div>
      )}
    </>
  );
}

/** What was set again on a new server. */
export function Restored() {
  const count = restored.value;
  if (count === undefined) return null;
  return (
    <div class="notice" role="status">
      The server was started anew; {count === 1 ? "the change" : `the ${count} changes`} of before {count === 1 ? "was" : "were"} set again.{" "}
      <button type="button" onClick={undo}>Undo</button> <button type="button" onClick={() => (restored.value = undefined)}>Keep</button>
    </div>
  );
}

export function Command() {
  const text = command.value;
  const off = link.value !== "open";
  if (hello.value === undefined) return null;
  return (
    <div class="command" role="group" aria-label="The same as a command">
      {text !== "" && (
        <>
          {other.value !== undefined && <strong>{edited.value.toUpperCase()}</strong>}
          <code tabIndex={0} role="region" aria-label="Command">{text}</code>
          <button type="button" class="quiet" onClick={() => void copy_command()} title="what makes these very files (c)">{copied.value ? "Copied" : "Copy"}</button>
        </>
      )}
      <button type="button" class="quiet" onClick={() => save(edited.value)} disabled={off || cannot("save") !== undefined} title={cannot("save") ?? "the scene with all changes, as a file (s)"}>Save YAML</button>
      <button type="button" class="quiet" onClick={() => (keep_open.value = true)} title="record frames, write a page, take a picture, make a film (r)">Take along …</button>
      <span class="unseen" role="status">{copied.value ? "The command is copied." : ""}</span>
    </div>
  );
}
