// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// All raw frames of a kind as small pictures with one scale of colours; a click enlarges one.

import { useEffect, useRef } from "preact/hooks";
import { reading } from "./keys";
import { shown_by } from "./compare";
import type { Side } from "./protocol";
import { exposure_text, kind_info, raw_name, type Exposure, type RawKind } from "./raw";
import { enlarge } from "./sheet_state";
import { mount } from "./stage";
import { cursor, exposures, focused, frame_of, other, view } from "./store";

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

export function Sheet({ pane, side, kind }: { pane: number; side: Side; kind: RawKind }) {
  const shows = shown_by(side);
  const all = exposures(shows === "b" ? "b" : "a");
  const whose = other.value === undefined ? "" : shows === "wipe" ? "A, and B right of the line" : shows === "difference" ? "B − A" : shows.toUpperCase();
  return (
    <div class="sheet" role="group" aria-label={`${kind_info(kind).title}: all raw frames${whose === "" ? "" : ` of ${whose}`}`} data-kind={kind}>
      {whose !== "" && <p class="of-sheet"><strong>{whose}</strong></p>}
      {frame_of(side)?.draft === true && <p class="of-sheet faint">draft</p>}
      {all.map((one) => <Tile key={one.number} pane={pane} side={side} kind={kind} of={one} />)}
    </div>
  );
}
