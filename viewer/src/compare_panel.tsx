// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Two states: how they are looked at, and in what they differ.

import { useSignal } from "@preact/signals";
import { toggle_other } from "./actions";
import { has_difference } from "./compare";
import { Key } from "./control";
import { open_other, set_state, text_now } from "./edit";
import type { Override, Side } from "./protocol";
import { cannot, comparing, controls, flipped, link, other, state, type Comparing } from "./store";

const ways: readonly { way: Comparing; said: string; title: string }[] = [
  { way: "beside", said: "Side by side", title: "A and B beside each other" },
  { way: "wipe", said: "Wipe", title: "A to a line, B behind it" },
  { way: "flip", said: "Flip", title: "A or B in the same place; b shows B while it is held down" },
  { way: "difference", said: "Difference", title: "B − A: blue is less, red more" },
];

/** Above the pictures, while there are two states. */
export function CompareBar() {
  if (other.value === undefined) return null;
  const how = comparing.value;
  const choose = (way: Comparing): void => {
    flipped.value = false;
    comparing.value = way;
  };
  return (
    <div class="compare-bar" role="group" aria-label="A | B">
      <div class="choices">
        {ways.map(({ way, said, title }) => <button key={way} type="button" aria-pressed={how === way} onClick={() => choose(way)} title={`${title} (v: the next way)`}>{said}</button>)}
      </div>
      {how === "flip" && (
        <button type="button" aria-pressed={flipped.value} onClick={() => (flipped.value = !flipped.value)}>{flipped.value ? "B is shown" : "A is shown"}</button>
      )}
      {how === "difference" && !has_difference() && <span class="faint">A and B have other pixels: no difference of them.</span>}
      <span class="faint hint">b held down: B</span>
      <button type="button" class="quiet" onClick={toggle_other} disabled={link.value !== "open"} title="closes B (a)">Close B</button>
    </div>
  );
}

/** What is in force, as far as it is known. */
function text_of(key: string, side: Side, overrides: readonly Override[]): string {
  const row = controls[side].value?.by_key.get(key);
  return row === undefined ? overrides.filter((one) => one.key === key).at(-1)?.text ?? "–" : text_now(row, side);
}

interface Differing {
  key: string;
  a: string;
  b: string;
}

function Rows({ rows }: { rows: readonly Differing[] }) {
  return (
    <>
      {rows.map(({ key, a, b }) => (
        <tr key={key} data-differs={key}><th scope="row"><Key of={key} /></th><td>{a}</td><td>{b}</td></tr>
      ))}
    </>
  );
}

/** What was changed on either side and differs, and behind it all values that do, be it by another mode. */
function Differences() {
  const [a, b] = [state.value, other.value];
  const all = useSignal(false);
  if (a === undefined || b === undefined) return null;
  const lists = { a: a.overrides, b: b.overrides };
  const keys = [...new Set([...lists.a, ...lists.b].map((one) => one.key))];
  const of_keys = (of: readonly string[]): Differing[] =>
    of.map((key) => ({ key, a: text_of(key, "a", lists.a), b: text_of(key, "b", lists.b) })).filter((one) => one.a !== one.b);
  const whole: Differing[] = [
    { key: "scene", a: a.scene ?? "", b: b.scene ?? "" },
    { key: "seed", a: String(a.seed), b: String(b.seed) },
  ];
  const first = [...whole.filter((one) => one.a !== one.b), ...of_keys(keys)];
  const others = all.value ? of_keys([...new Set([...(controls.a.value?.by_key.keys() ?? []), ...(controls.b.value?.by_key.keys() ?? [])])].filter((key) => !keys.includes(key))) : [];
  return (
    <>
      {first.length === 0 ? <p class="same">A and B are the same. Change something: the switch A | B above the controls says of which.</p> : (
        <table class="differences">
          <caption>What differs</caption>
          <thead><tr><th scope="col">key</th><th scope="col">A</th><th scope="col">B</th></tr></thead>
          <tbody><Rows rows={first} /></tbody>
        </table>
      )}
      <details open={all.value} onToggle={(event) => (all.value = event.currentTarget.open)}>
        <summary>Other values in force that differ</summary>
        {all.value && (others.length === 0 ? <p class="faint">None.</p> : (
          <table class="differences"><thead><tr><th scope="col">key</th><th scope="col">A</th><th scope="col">B</th></tr></thead><tbody><Rows rows={others} /></tbody></table>
        ))}
      </details>
    </>
  );
}

function OtherScene() {
  const name = useSignal("");
  const off = link.value !== "open" || cannot("other", "a") !== undefined;
  return (
    <form class="other-scene" onSubmit={(event) => {
      event.preventDefault();
      if (name.value.trim() !== "") open_other([], state.value?.seed ?? 0, name.value.trim());
    }}>
      <label for="other-scene">B: another scene or camera that comes with tofray</label>
      <div><input id="other-scene" type="text" autoComplete="off" spellcheck={false} placeholder="azure-kinect-nfov" value={name.value} onInput={(event) => (name.value = event.currentTarget.value)} />{" "}
      <button type="submit" disabled={off}>Open</button></div>
    </form>
  );
}

export function ComparePanel() {
  const [a, b] = [state.value, other.value];
  const why = cannot("other", "a");
  const off = link.value !== "open" || why !== undefined;
  if (a === undefined || b === undefined) {
    return (
      <>
        {why !== undefined && <p class="hint">{why}</p>}
        <p>Two states of the camera, looked at together. B begins as a copy of A, with the same noise: what differs then is what you change.</p>
        <p><button type="button" class="main-button" onClick={toggle_other} disabled={off}>Open B</button></p>
        <OtherScene />
      </>
    );
  }
  const same_scene = b.scene === undefined || b.scene === a.scene;
  const swap = (): void => {
    set_state("a", b.overrides, b.seed);
    set_state("b", a.overrides, a.seed);
  };
  return (
    <>
      <Differences />
      <div class="compare-actions">
        <button type="button" onClick={swap} disabled={off || !same_scene}>Swap A and B</button>
        <button type="button" onClick={() => set_state("a", b.overrides, b.seed)} disabled={off || !same_scene}>A as B</button>
        <button type="button" onClick={() => (same_scene ? set_state("b", a.overrides, a.seed) : open_other(a.overrides, a.seed))} disabled={off}>B as A</button>
        <button type="button" onClick={toggle_other} disabled={off}>Close B</button>
      </div>
      <OtherScene />
    </>
  );
}
