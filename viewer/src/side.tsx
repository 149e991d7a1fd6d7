// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Beside the pictures: controls, the pixel, pinned pixels, two states. One at a time, or, where there is room, the controls beside the others.

import { ComparePanel } from "./compare_panel";
import { ControlsPanel } from "./controls_panel";
import { MeasurePanel } from "./measure_panel";
import { PixelPanel } from "./pixel_panel";
import { tab, tab_shown, wide, type Tab } from "./store";
import { WatchPanel } from "./watch_panel";

const tabs: readonly { tab: Tab; said: string }[] = [
  { tab: "controls", said: "Controls" },
  { tab: "pixel", said: "Pixel" },
  { tab: "watch", said: "Watch" },
  { tab: "measure", said: "Measure" },
  { tab: "compare", said: "A | B" },
];

/** Arrow keys go from tab to tab, Tab into what it shows. */
function go(event: KeyboardEvent, offered: readonly Tab[]): void {
  const by = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
  if (by === undefined) return;
  event.preventDefault();
  const to = offered[(offered.indexOf(tab_shown.value) + by + offered.length) % offered.length]!;
  tab.value = to;
  document.getElementById(`tab-${to}`)?.focus();
}

export function ControlsColumn() {
  if (!wide.value) return null;
  return <aside class="panel" aria-label="Controls"><h2>Controls</h2><ControlsPanel /></aside>;
}

export function Side() {
  const now = tab_shown.value;
  const offered = tabs.filter((one) => !wide.value || one.tab !== "controls");
  return (
    <aside class="panel side" aria-label={offered.find((one) => one.tab === now)?.said ?? ""}>
      <div class="tabs" role="tablist" aria-label="Beside the pictures" onKeyDown={(event) => go(event, offered.map((one) => one.tab))}>
        {offered.map((one) => (
          <button key={one.tab} type="button" role="tab" id={`tab-${one.tab}`} aria-selected={now === one.tab} aria-controls="tab-panel" tabIndex={now === one.tab ? 0 : -1}
            onClick={() => (tab.value = one.tab)}>{one.said}</button>
        ))}
      </div>
      <div id="tab-panel" role="tabpanel" aria-labelledby={`tab-${now}`} tabIndex={0}>
        {now === "controls" ? <><h2 class="unseen">Controls</h2><ControlsPanel /></> : now === "pixel" ? <PixelPanel /> : now === "watch" ? <><h2>Watch list</h2><WatchPanel /></> : now === "measure" ? <><h2 class="unseen">Measure</h2><MeasurePanel /></> : <><h2 class="unseen">A | B</h2><ComparePanel /></>}
      </div>
    </aside>
  );
}
