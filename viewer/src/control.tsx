// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// One key: its value in force, to be typed with a unit, dragged, chosen or switched. Ranges, units and sentences are the row's.

import { useSignal } from "@preact/signals";
import { drag_key, fault_place, forget_fault, set_key, text_now, unanswered, unset_key } from "./edit";
import { begin_gesture, end_gesture } from "./history";
import { number_text } from "./numbers";
import type { Fault, Row, Side } from "./protocol";
import { cannot, edited, key_faults, link, other, state } from "./store";
import { number_in, place_of_value, places, text_at, with_unit_of, type Ends } from "./slider";

/** The ends of sliders as they were first shown: they do not run away under the hand. */
const kept_ends = new Map<string, Ends>();

function ends_of(row: Row, place: string, value: number): Ends | undefined {
  if (row.slider === undefined || !(row.slider[1] > row.slider[0])) return undefined;
  const kept = kept_ends.get(place);
  const [low, high] = row.slider;
  // At an end, and beyond, those of the value that is in force now.
  if (kept !== undefined && value > kept[0] && value < kept[1]) return kept;
  kept_ends.set(place, [low, high]);
  return [low, high];
}

const opposites: Readonly<Record<string, string>> = { true: "false", false: "true", on: "off", off: "on", yes: "no", no: "yes" };

export function is_changed(row: Row, side: Side): boolean {
  return ((side === "a" ? state.value : other.value)?.overrides ?? []).some((one) => one.key === row.key);
}

/** What may be typed: the range, the units, and what holds unless it is. */
function range_of(row: Row): string {
  const { low, high, kind } = row;
  const others = (row.units ?? []).filter((unit) => unit !== row.unit && unit !== "");
  const number = (value: number): string => with_unit_of(row, number_text(Number(value.toPrecision(6))));
  const is_number = kind === "number" || kind === "integer" || kind === "vector";
  const range = !is_number ? ""
    : low !== undefined && high !== undefined ? `${number(low)} to ${number(high)}`
    : low !== undefined ? `from ${number(low)}`
    : high !== undefined ? `up to ${number(high)}` : "";
  const unless = row.default === undefined || row.default === "" ? "" : `unless given ${row.default}`;
  return [range, others.length === 0 ? "" : `also ${others.join(", ")}`, unless, row.settable === false ? "not with what is in force" : ""].filter((one) => one !== "").join("; ");
}

/** @param part   what of the key it moves, in words; empty: all of it
 *  @param whole  the key's text with this number in it */
function Slider({ row, side, part, value, off, whole, said }: {
  row: Row; side: Side; part: string; value: number; off: boolean; whole: (number: string) => string; said: (text: string | undefined) => void;
}) {
  const held = useSignal<number | undefined>(undefined);
  const ends = ends_of(row, `${fault_place(side, row.key)} ${part}`, value);
  if (ends === undefined) return null;
  const begin = (): void => {
    if (held.value !== undefined) return;
    held.value = place_of_value(value, ends, row.log === true);
    begin_gesture();
  };
  const end = (): void => {
    if (held.value === undefined) return;
    held.value = undefined;
    end_gesture();
    said(undefined);
  };
  const at = held.value ?? place_of_value(value, ends, row.log === true);
  return (
    <input type="range" min={0} max={places} value={at} disabled={off} aria-label={`${row.key}${part === "" ? "" : ` ${part}`}, slider`} aria-valuetext={text_at(at, ends, row)}
      onPointerDown={begin} onPointerUp={end} onPointerCancel={end} onKeyUp={end} onBlur={end}
      onInput={(event) => {
        begin();
        held.value = event.currentTarget.valueAsNumber;
        const text = whole(text_at(held.value, ends, row));
        said(text);
        drag_key(side, row.key, text);
      }} />
  );
}

const axes = ["x", "y", "z", "w"];

/** A slider for each number of a vector. */
function Sliders({ row, side, text, off, said }: { row: Row; side: Side; text: string; off: boolean; said: (text: string | undefined) => void }) {
  const words = /^\[(.*)\]$/.exec(text.trim())?.[1]?.split(",").map((one) => one.trim());
  const typed = words?.map((word) => number_in(word, row));
  const values = typed !== undefined && typed.every((one) => one !== undefined) ? typed as number[] : Array.isArray(row.value) && text === row.text ? row.value : undefined;
  if (values === undefined || values.length > axes.length) return null;
  const texts = words?.length === values.length ? words : values.map((one) => with_unit_of(row, String(one)));
  return (
    <div class="axes">
      {values.map((value, i) => (
        <div key={i}>
          <span aria-hidden="true">{axes[i]}</span>
          <Slider row={row} side={side} part={axes[i]!} value={value} off={off} said={said} whole={(number) => `[${texts.map((one, at) => (at === i ? number : one)).join(", ")}]`} />
        </div>
      ))}
    </div>
  );
}

/** Text that is sent with Enter, or when another field is gone to; Escape takes it back, or leaves the field. */
function Field({ row, side, text, fault, id, off, described, range }: { row: Row; side: Side; text: string; fault: Fault | undefined; id: string; off: boolean; described: string; range: string }) {
  const typed = useSignal<string | undefined>(undefined);
  const sent = useSignal<string | undefined>(undefined);
  const refused = fault === undefined ? undefined : sent.value;
  const asked = unanswered.value > 0 ? sent.value : undefined;
  const send = (now: string): void => {
    if (now === (refused ?? text) || now.trim() === "") return void (typed.value = undefined);
    sent.value = now;
    typed.value = undefined;
    set_key(side, row.key, now.trim());
  };
  return (
    <input id={id} type="text" value={typed.value ?? refused ?? asked ?? text} disabled={off} title={range} autoComplete="off" spellcheck={false} aria-invalid={fault !== undefined} aria-describedby={described}
      onInput={(event) => (typed.value = event.currentTarget.value)}
      onChange={(event) => send(event.currentTarget.value)}
      onKeyDown={(event) => {
        if (event.key !== "Escape") return;
        const untouched = typed.value === undefined && fault === undefined;
        typed.value = sent.value = undefined;
        forget_fault(side, row.key);
        event.currentTarget.value = text;
        if (untouched) event.currentTarget.blur();
      }} />
  );
}

function Choice({ row, side, text, id, off, described }: { row: Row; side: Side; text: string; id: string; off: boolean; described: string }) {
  const choices = row.choices ?? [];
  return (
    <select id={id} value={text} disabled={off} aria-describedby={described} onChange={(event) => set_key(side, row.key, event.currentTarget.value)}>
      {!choices.includes(text) && <option value={text}>{text === "" ? "–" : text}</option>}
      {choices.map((one) => <option key={one} value={one}>{one}</option>)}
    </select>
  );
}

/** A key, which may be broken behind its dots. */
export function Key({ of }: { of: string }) {
  const words = of.split(".");
  const last = words.pop() ?? "";
  return <>{words.map((word, i) => <span key={i} class="faint">{word}.<wbr /></span>)}{last.split("_").map((word, i) => <span key={i}>{i > 0 && <>_<wbr /></>}{word}</span>)}</>;
}

/** @param label  the key as it is called where it stands: all of it, or behind its group */
export function Control({ row, label }: { row: Row; label: string }) {
  const side = edited.value;
  const said = useSignal<string | undefined>(undefined);
  const place = fault_place(side, row.key);
  const fault = key_faults.value.get(place);
  const text = text_now(row, side);
  const off = link.value !== "open" || row.settable === false || cannot("set") !== undefined;
  const changed = is_changed(row, side);
  const id = `key-${row.key}`;
  const [what, wrong] = [`${id}-what`, `${id}-wrong`];
  const value = number_in(text, row) ?? (typeof row.value === "number" ? row.value : undefined);
  const own = typeof row.value === "number" && text === (row.text ?? "") ? row.value : value;
  const described = fault === undefined ? what : `${wrong} ${what}`;
  const is_field = row.kind !== "choice" && row.kind !== "switch";
  const range = range_of(row);
  return (
    <div class={`control${changed ? " changed" : ""}${row.settable === false ? " excluded" : ""}`} data-key={row.key} data-kind={row.kind}>
      <div class="control-head">
        <label for={id} title={row.key}><Key of={label} /></label>
        {changed && <button type="button" class="quiet reset" disabled={link.value !== "open" || cannot("set") !== undefined} onClick={() => unset_key(side, row.key)} aria-label={`Reset ${row.key}`} title="as it was">↺</button>}
        {row.kind === "switch" && (
          <input id={id} type="checkbox" checked={text === "true" || text === "on" || text === "yes"} disabled={off} aria-describedby={described}
            onChange={() => set_key(side, row.key, opposites[text] ?? "true")} />
        )}
        {row.kind === "choice" && <Choice row={row} side={side} text={text} id={id} off={off} described={described} />}
        {is_field && <Field row={row} side={side} text={said.value ?? text} fault={fault} id={id} off={off} described={described} range={range} />}
      </div>
      {own !== undefined && (row.kind === "number" || row.kind === "integer") && row.settable !== false && (
        <Slider row={row} side={side} part="" value={own} off={off} whole={(number) => number} said={(to) => (said.value = to)} />
      )}
      {row.kind === "vector" && row.slider !== undefined && row.settable !== false && <Sliders row={row} side={side} text={said.value ?? text} off={off} said={(to) => (said.value = to)} />}
      {fault !== undefined && (
        <p class="wrong" id={wrong} role="alert">
          <strong>{fault.text}</strong> {fault.more !== undefined && fault.more !== "" && <span>{fault.more}</span>}
          <button type="button" class="quiet" onClick={() => forget_fault(side, row.key)}>Keep {text === "" ? "it as it was" : text}</button>
        </p>
      )}
      <p class="what" id={what}>
        {row.assumed === true && <span class="assumed" title={row.source ?? ""}>assumed</span>}{" "}
        <span title={row.source === undefined ? "" : `source: ${row.source}`}>{row.what ?? ""}</span>
        {row.source !== undefined && <span class="unseen"> Source: {row.source}.</span>}
        {range !== "" && <span class="unseen"> {range}</span>}
      </p>
    </div>
  );
}
