// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// All raw frames of a kind as small pictures with one scale of colours; a click enlarges one.

import { useEffect, useRef } from "preact/hooks";
import { reading } from "./keys";
import { css, ink_on } from "./colors";
import { shown_by } from "./compare";
import { saturation_of } from "./picture";
import type { Side } from "./protocol";
import { exposure_text, kind_info, raw_name, type Exposure, type RawKind } from "./raw";
import { enlarge } from "./sheet_state";
import { mount } from "./stage";
import { array_of, cursor, exposures, focused, frame_of, hello, other, view } from "./store";

function Tile({ pane, side, kind, of }: { pane: number; side: Side; kind: RawKind; of: Exposure }) {
  const stage = useRef<HTMLDivElement>(null);
  const name = useRef("");
  name.current = raw_name(kind, of.number);
  const enlarged = (): void => {
    focused.value = pane;
    enlarge(pane, kind, of.number);
  };
  const click = useRef(enlarged);
  click.current = enlarged;
  useEffect(() => {
    if (stage.current === null) return undefined;
    return mount({ place: `${pane}${side} ${of.number}`, name: () => name.current, side, stage: stage.current, clicked: () => click.current(), tile: true });
  }, []);
  const shows = shown_by(side);
  const value = cursor.value === undefined ? "" : reading(name.current, shows === "b" ? "b" : "a");
  const said = exposure_text(of);
  return (
    <figure class={`tile${of.first ? " first" : ""}`} data-raw={of.number}>
      <div ref={stage} class="stage" tabIndex={0} role="button" aria-label={`${kind_info(kind).title}, raw frame ${of.number}, ${said}: enlarge. Arrow keys move the pixel cursor.`}
        style={{ touchAction: view.value.zoom > 1 ? "none" : "pan-y pinch-zoom" }}
        onKeyDown={(event) => {
          if (event.key !== "Enter" && event.key !== " ") return;
          event.preventDefault();
          enlarged();
        }}>
        <canvas class="front" />
        <canvas class="over" />
      </div>
      <figcaption><strong>{of.number}</strong> {said} {shows !== "difference" && shows !== "wipe" && value !== "" && <span class="tile-value">{value}</span>}</figcaption>
    </figure>
  );
}

/** How many pixels were full in a raw frame, and how they are marked. */
function Saturated({ side }: { side: Side }) {
  const greeting = hello.value;
  const of = greeting && saturation_of(greeting);
  const flags = array_of(frame_of(side), "flags")?.values;
  if (of === undefined || flags === undefined) return null;
  let count = 0;
  for (const one of flags) if (((one >>> of.bit) & 1) !== 0) ++count;
  return (
    <p class="of-sheet faint" data-saturated={count}>
      <span class="swatch struck" style={{ background: css(of.color), color: ink_on(of.color) }}>{of.letter}</span>{" "}
      {count === 0 ? "no pixel is saturated" : `${count} ${count === 1 ? "pixel is" : "pixels are"} saturated: full in one raw frame at least, struck through in all`}
    </p>
  );
}

export function Sheet({ pane, side, kind }: { pane: number; side: Side; kind: RawKind }) {
  const shows = shown_by(side);
  const all = exposures(shows === "b" ? "b" : "a");
  const whose = other.value === undefined ? "" : shows === "wipe" ? "A, and B right of the line" : shows === "difference" ? "B − A" : shows.toUpperCase();
  return (
    <div class="sheet" role="group" aria-label={`${kind_info(kind).title}: all raw frames${whose === "" ? "" : ` of ${whose}`}`} data-kind={kind}>
      {whose !== "" && <p class="of-sheet"><strong>{whose}</strong></p>}
      <Saturated side={shows === "b" ? "b" : "a"} />
      {frame_of(side)?.draft === true && <p class="of-sheet faint">draft</p>}
      {all.map((one) => <Tile key={one.number} pane={pane} side={side} kind={kind} of={one} />)}
    </div>
  );
}
