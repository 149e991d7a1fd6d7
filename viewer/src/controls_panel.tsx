// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Every key of scene and camera: searched, or gone to by part and group. A group's controls are made when it is opened.

import { Control, Key } from "./control";
import { set_seed, set_state, unset_key } from "./edit";
import { future, past, redo, undo } from "./history";
import type { Override, Row, Side } from "./protocol";
import { found, meant } from "./search";
import { cannot, controls, edited, hello, link, open_groups, other, search, state } from "./store";

const most_found = 40;

interface Group {
  name: string;
  rows: Row[];
}

interface Part {
  name: string;
  groups: Group[];
}

function parts_of(rows: readonly Row[]): Part[] {
  const parts: Part[] = [];
  for (const row of rows) {
    let part = parts.find((one) => one.name === row.part);
    if (part === undefined) parts.push(part = { name: row.part, groups: [] });
    let group = part.groups.find((one) => one.name === row.group);
    if (group === undefined) part.groups.push(group = { name: row.group, rows: [] });
    group.rows.push(row);
  }
  return parts;
}

function overrides_of(side: Side): readonly Override[] {
  return (side === "a" ? state.value : other.value)?.overrides ?? [];
}

function Seed({ side }: { side: Side }) {
  const seed = (side === "a" ? state.value : other.value)?.seed ?? 0;
  const send = (text: string): boolean => {
    const number = Number(text);
    const fits = /^\d+$/.test(text) && Number.isSafeInteger(number);
    if (fits && number !== seed) set_seed(side, number);
    return fits;
  };
  return (
    <div class="seed">
      <label for="seed">seed of the noise</label>
      <input id="seed" type="text" inputMode="numeric" autoComplete="off" value={String(seed)} disabled={link.value !== "open" || cannot("seed") !== undefined}
        onChange={(event) => send(event.currentTarget.value) || (event.currentTarget.value = String(seed))} />
    </div>
  );
}

/** Every `--set`, those of the command line, too, in order. */
function Changed({ side }: { side: Side }) {
  const overrides = overrides_of(side);
  const off = link.value !== "open" || cannot("set") !== undefined;
  if (overrides.length === 0) return <p class="faint none-changed">Nothing is changed. Move a slider, or type a value with its unit.</p>;
  return (
    <section class="changes" aria-label="Changed">
      <div class="changes-head">
        <h3>{overrides.length} changed</h3>
        <button type="button" class="quiet" disabled={off} onClick={() => set_state(side, [], (side === "a" ? state.value : other.value)?.seed ?? 0)}>Reset all</button>
      </div>
      <ul>
        {overrides.map(({ key, text }, i) => (
          <li key={`${key} ${i}`} data-changed={key}>
            <button type="button" class="link" onClick={() => (search.value = key)} title="to its control"><Key of={key} /></button>
            <span class="now">{text}</span>
            <button type="button" class="quiet reset" disabled={off} onClick={() => unset_key(side, key)} aria-label={`Reset ${key}`} title="as it was">↺</button>
          </li>
        ))}
      </ul>
    </section>
  );
}

/** An object is called by its name, too. */
function title_of(part: string, { name, rows }: Group): string {
  if (name === "") return part === "camera" ? "general" : part;
  const called = rows.find((row) => row.label !== undefined)?.label ?? "";
  return called === "" ? name : `${name} · ${called}`;
}

function GroupOf({ part, group, side }: { part: string; group: Group; side: Side }) {
  const place = `${part} ${group.name}`;
  const open = open_groups.value.has(place);
  const changed = group.rows.filter((row) => overrides_of(side).some((one) => one.key === row.key)).length;
  const toggle = (now: boolean): void => {
    if (now === open_groups.peek().has(place)) return;
    const groups = new Set(open_groups.peek());
    if (now) groups.add(place);
    else groups.delete(place);
    open_groups.value = groups;
  };
  return (
    <details class="group" open={open} onToggle={(event) => toggle(event.currentTarget.open)}>
      <summary>
        {title_of(part, group)} <span class="faint count">{group.rows.length}</span>
        {changed > 0 && <span class="count-changed">{changed} changed</span>}
      </summary>
      {open && group.rows.map((row) => <Control key={`${side} ${row.key}`} row={row} label={row.name} />)}
    </details>
  );
}

function Tree({ rows, side }: { rows: readonly Row[]; side: Side }) {
  return (
    <>
      {parts_of(rows).map((part) => (
        <section key={part.name} aria-label={part.name}>
          <h3 class="part">{part.name}</h3>
          {part.groups.map((group) => <GroupOf key={group.name} part={part.name} group={group} side={side} />)}
        </section>
      ))}
    </>
  );
}

function Found({ rows, side }: { rows: readonly Row[]; side: Side }) {
  const all = found(rows, search.value);
  const other_words = all.length === 0 ? meant(rows, search.value) : undefined;
  return (
    <section aria-label="Found">
      <p class="faint" role="status">{all.length === 0 ? `No key has “${search.value}”.` : `${all.length} found${all.length > most_found ? `, the first ${most_found}` : ""}`}</p>
      {other_words !== undefined && <p>Did you mean <button type="button" class="link" onClick={() => (search.value = other_words)}>{other_words}</button>?</p>}
      {all.slice(0, most_found).map((row) => <Control key={`${side} ${row.key}`} row={row} label={row.key} />)}
    </section>
  );
}

export function Sides() {
  if (other.value === undefined) return null;
  return (
    <div class="choices" role="group" aria-label="Controls of">
      {(["a", "b"] as const).map((side) => (
        <button key={side} type="button" aria-pressed={edited.value === side} onClick={() => (edited.value = side)}>{side.toUpperCase()}</button>
      ))}
    </div>
  );
}

export function UndoRedo() {
  const off = link.value !== "open";
  return (
    <div class="buttons">
      <button type="button" onClick={undo} disabled={off || past.value.length === 0} aria-label="Undo" title="undo (Ctrl+Z)">
        <svg viewBox="0 0 16 16" width="16" height="16" aria-hidden="true"><path d="M6 2 2 6l4 4M2.5 6H10a4 4 0 0 1 0 8H6" fill="none" stroke="currentColor" stroke-width="1.6" /></svg>
      </button>
      <button type="button" onClick={redo} disabled={off || future.value.length === 0} aria-label="Redo" title="redo (Ctrl+Y)">
        <svg viewBox="0 0 16 16" width="16" height="16" aria-hidden="true"><path d="m10 2 4 4-4 4m3.5-4H6a4 4 0 0 0 0 8h4" fill="none" stroke="currentColor" stroke-width="1.6" /></svg>
      </button>
    </div>
  );
}

export function ControlsPanel() {
  const side = edited.value;
  const keys = controls[side].value;
  const fixed = cannot("set");
  const rows = keys?.rows;
  return (
    <div class="controls">
      <div class="controls-head">
        <Sides />
        <input id="search" type="search" value={search.value} onInput={(event) => (search.value = event.currentTarget.value)} autoComplete="off" spellcheck={false}
          aria-label="Search the controls" placeholder="Search: f num" onKeyDown={(event) => {
            if (event.key !== "Escape") return;
            if (search.value === "") event.currentTarget.blur();
            search.value = "";
          }} />
      </div>
      {fixed !== undefined && <p class="hint" data-fixed>{fixed}</p>}
      {(fixed === undefined || overrides_of(side).length > 0) && <Changed side={side} />}
      {rows === undefined && cannot("controls") !== undefined ? null : rows === undefined ? <p class="faint">asked …</p> : search.value.trim() !== "" ? <Found rows={rows} side={side} /> : (
        <>
          <Tree rows={rows} side={side} />
          {(keys?.left_out ?? 0) > 0 && <p class="faint">{keys?.left_out} more keys of objects are not listed; <code>--set</code> takes them.</p>}
          {cannot("seed", side) === undefined || hello.value?.source === undefined ? <Seed side={side} /> : null}
        </>
      )}
    </div>
  );
}
