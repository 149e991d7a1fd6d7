// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
import { toggle_other } from "./actions";
import { shown_array } from "./cloud";
import { CompareBar } from "./compare_panel";
import { UndoRedo } from "./controls_panel";
import { Help } from "./help";
import { KeepDialog } from "./keep_dialog";
import { reading } from "./keys";
import { Pane } from "./pane";
import { is_sheet } from "./raw";
import { ControlsColumn, Side } from "./side";
import { BroughtBack, SourceNote } from "./source_note";
import { Command, Restored, Status, Troubles } from "./status";
import { cannot, comparing, cursor, hello, help_open, link, other, shown, size, spoken, title_of } from "./store";
import { TimeLine } from "./time_line";
import { Moved, ToolBar } from "./tool_bar";
import { tool } from "./tools";

/** What every pane shows at the cursor, at once. */
function ReadOut() {
  const at = cursor.value;
  if (at === undefined) return <p class="read-out faint">Point at a picture to read its values; click for all there is to know of a pixel.</p>;
  const arrays = [...new Set([...shown.value.filter((array) => !is_sheet(array)).map(shown_array), ...(hello.value?.panes.some((pane) => pane.array === "flags") ? ["flags"] : [])])];
  return (
    <dl class="read-out" aria-label="Read-out">
      <div><dt>pixel</dt><dd>{at.u}, {at.v}</dd></div>
      {arrays.map((array) => <div key={array}><dt>{title_of(array)}{other.value === undefined ? "" : " of A"}</dt><dd data-reading={array}>{reading(array)}</dd></div>)}
    </dl>
  );
}

export function App() {
  const of = hello.value;
  const { width, height } = size.value;
  return (
    <>
      <header>
        <img src={TOFRAY_ICON} alt="" width="28" height="28" />
        <h1><span class="unseen">tofray view: </span><bdi>{of?.scene ?? "tofray view"}</bdi></h1>
        {of !== undefined && <p class="faint camera"><bdi>{of.camera}</bdi>{of.mode === "" ? "" : " · "}<bdi>{of.mode}</bdi> · {width} × {height}</p>}
        <UndoRedo />
        <button type="button" class="quiet" aria-pressed={other.value !== undefined} onClick={toggle_other} disabled={link.value !== "open" || cannot("other", "a") !== undefined} title={cannot("other", "a") ?? "two states, looked at together (a)"}>A | B</button>
        <ToolBar />
        <Status />
        <button type="button" class="quiet" onClick={() => (help_open.value = true)} aria-label="Help: keys" title="keys (?)">?</button>
      </header>
      <Troubles />
      <Restored />
      <BroughtBack />
      <SourceNote />
      <main class={`${link.value === "open" ? "" : "stale"}${tool.value === "drag" ? " drags" : ""}`}>
        <ControlsColumn />
        <div class={`middle panes-${shown.value.length}${other.value !== undefined && comparing.value === "beside" ? " double" : ""}`}>
          <CompareBar />
          {shown.value.map((_, i) => <Pane key={i} pane={i} />)}
        </div>
        <Side />
        <Moved />
      </main>
      <footer>
        <ReadOut />
        <TimeLine />
        <Command />
      </footer>
      <div class="unseen" role="log" aria-live="polite" aria-label="Pixel cursor" id="spoken">{spoken.value}</div>
      <Help />
      <KeepDialog />
    </>
  );
}
