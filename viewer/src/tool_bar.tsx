// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
import { what, moving } from "./hands";
import { cannot, focused, link, shown } from "./store";
import { cloud_color } from "./cloud";
import { toggle_space } from "./space_state";
import { choose_tool, grabbed, tool } from "./tools";

/** What a press on a picture does. */
export function ToolBar() {
  const off = link.value !== "open";
  const now = tool.value;
  const in_space = cloud_color(shown.value[focused.value] ?? "") !== undefined;
  return (
    <div class="tool-bar" role="group" aria-label="Tools">
      <button type="button" class="quiet" aria-pressed={now === "drag"} disabled={off || cannot("drag") !== undefined} onClick={() => choose_tool("drag")} title={cannot("drag") ?? "drag objects in a picture: parallel to the image, with Shift along the ray, with Ctrl they turn, Alt and wheel scale (d)"}>Move</button>
      <button type="button" class="quiet" aria-pressed={now === "measure"} disabled={cannot("measure") !== undefined} onClick={() => choose_tool("measure")} title={cannot("measure") ?? "the distance between two points, measured and true (m)"}>Measure</button>
      <button type="button" class="quiet" aria-pressed={in_space} disabled={cannot("view3d") !== undefined} onClick={() => toggle_space(focused.value)} title={cannot("view3d") ?? "points in space in the pane that has the focus (x)"}>3D</button>
    </div>
  );
}

/** What a gesture makes, while it is made: over the pictures, which keep their places. */
export function Moved() {
  const held = moving.value || grabbed.value !== undefined;
  const text = held || tool.value === "drag" ? what.value : "";
  return <div class="moved-place"><span class={text === "" ? "unseen" : "moved"} role="status">{text === "" ? "" : `${held ? "" : "moved: "}${text}`}</span></div>;
}
