// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
import { useSignal, type Signal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { css } from "./colors";
import { other, title_of } from "./store";
import { gizmo, orbit, scene_style, selected, selected_object, space_side, through, view3d_fault, view3d_of, with_axes, with_camera, with_lights, with_truth } from "./space";
import { select, SpaceView, toggle_through, type Drawing } from "./space_view";
import { truth_color, type Gizmo, type SceneStyle } from "./stage3d";

function Switch({ of, children, title }: { of: Signal<boolean>; children: preact.ComponentChildren; title: string }) {
  return <button type="button" aria-pressed={of.value} onClick={() => (of.value = !of.value)} title={title}>{children}</button>;
}

/** What of the scene is drawn, from where it is seen, and which object is taken hold of. */
function Options({ drawing }: { drawing: Drawing }) {
  const side = space_side.value;
  const objects = view3d_of(side)?.objects ?? [];
  const chosen = selected_object(side);
  const fixed_here = chosen !== undefined && !chosen.movable;
  const hold = (to: Gizmo): void => void (gizmo.value = gizmo.value === to ? "off" : to);
  return (
    <div class="space-options" role="group" aria-label="3D">
      <Switch of={with_truth} title="the points that are true, beside those that are measured"><span class="key-dot" aria-hidden="true" style={{ background: css(truth_color) }} /> Truth</Switch>
      <label>
        <span class="unseen">The scene's surfaces</span>
        <select value={scene_style.value} onChange={(event) => (scene_style.value = event.currentTarget.value as SceneStyle)} title="the scene's surfaces, a colour for each object">
          <option value="off">no scene</option>
          <option value="wire">scene as wires</option>
          <option value="solid" disabled={drawing === "processor"}>scene solid</option>
        </select>
      </label>
      <Switch of={with_camera} title="what the camera sees: its frustum">Frustum</Switch>
      <Switch of={with_lights} title="where light goes: cones">Lights</Switch>
      <Switch of={with_axes} title="of the camera: x right, y down, z forward">Axes</Switch>
      <button type="button" aria-pressed={through.value} disabled={view3d_of(side)?.frustum == null} onClick={toggle_through} title="as the camera sees it; then a drag turns the camera (t)">Through the camera</button>
      <button type="button" onClick={() => ((through.value = false), (orbit.value = undefined))} title="from where it was first seen (0)">Home</button>
      <label>
        <span class="unseen">Object</span>
        <select class="object-choice" value={selected.value ?? ""} onChange={(event) => select(event.currentTarget.value === "" ? undefined : Number(event.currentTarget.value))} title="the object that is taken hold of (o: the next)">
          <option value="">no object</option>
          {objects.map((one) => <option key={one.id} value={one.id}>{one.name}</option>)}
        </select>
      </label>
      {drawing === "WebGL" && (
        <>
          <button type="button" aria-pressed={gizmo.value === "move"} disabled={chosen === undefined || fixed_here} onClick={() => hold("move")} title="handles that move the object">Move it</button>
          <button type="button" aria-pressed={gizmo.value === "turn"} disabled={chosen === undefined || fixed_here} onClick={() => hold("turn")} title="handles that turn the object">Turn it</button>
        </>
      )}
      {fixed_here && <p class="faint">{chosen.name} cannot be moved: {chosen.why ?? ""}</p>}
    </div>
  );
}

export function SpaceStage({ pane, array }: { pane: number; array: string }) {
  const outer = useRef<HTMLDivElement>(null);
  const view = useSignal<SpaceView | undefined>(undefined);
  useEffect(() => {
    const stage = outer.current;
    const inner = stage?.querySelector<HTMLElement>(".space-inner");
    const [gpu, flat] = stage?.querySelectorAll("canvas") ?? [];
    const labels = stage?.querySelector<HTMLElement>(".space-labels");
    const marks = stage?.querySelector<HTMLElement>(".space-marks");
    if (stage == null || inner == null || labels == null || marks == null || gpu === undefined || flat === undefined) return undefined;
    const made = new SpaceView(pane, stage, inner, gpu, flat, labels, marks);
    view.value = made;
    return () => made.dispose();
  }, []);
  const drawing = view.value?.drawing.value ?? "loading";
  const sentence = view.value?.sentence.value ?? "";
  const side = space_side.value;
  const fault = view3d_fault(side);
  const left_out = view3d_of(side)?.left_out ?? 0;
  return (
    <div class="space-of">
      <div ref={outer} class="stage space" tabIndex={0} role="application" data-drawing={drawing}
        aria-label={`${title_of(array)}${other.value === undefined ? "" : ` of ${side.toUpperCase()}`}: points in space. Arrow keys turn the view.`}>
        <div class="space-inner"><canvas class="gpu" hidden /><canvas class="flat" hidden /></div>
        <div class="space-labels" aria-hidden="true" />
        <div class="space-marks" aria-hidden="true" />
        {other.value !== undefined && <span class={`badge ${side}`} aria-hidden="true">{side.toUpperCase()}</span>}
        {drawing === "loading" && <p class="space-note" role="status">3D is fetched …</p>}
      </div>
      <p class="space-word" role="status">{sentence}{left_out > 0 && <span class="left-out" data-left-out={left_out}>{left_out === 1 ? "One object or light is" : `${left_out} objects and lights are`} not drawn: their list would be too long to send. Their points are all here.</span>}{fault === undefined ? "" : ` ${fault.text} ${fault.more ?? ""}`}</p>
      <Options drawing={drawing} />
    </div>
  );
}
