// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
import { Dialog } from "./dialog";
import { keys } from "./keys";
import { space_keys } from "./space_keys";
import { hello, help_open, letter_keys, set_letter_keys } from "./store";

export function Help() {
  return (
    <Dialog open={help_open} title="Keys" id="help">
      <dl class="keys">
        {keys.map((key) => (
          <div key={key.said}><dt><kbd>{key.said}</kbd></dt><dd>{key.does}</dd></div>
        ))}
        <div><dt><kbd>Escape</kbd></dt><dd>in a field: takes back what was typed, and then leaves the field, so that letters act again</dd></div>
      </dl>
      <h2>Keys in a 3D pane</h2>
      <dl class="keys space-keys">
        {space_keys.map((key) => (
          <div key={key.said}><dt><kbd>{key.said}</kbd></dt><dd>{key.does}</dd></div>
        ))}
      </dl>
      <h2>Mouse</h2>
      <dl>
        <div><dt>move</dt><dd>the pixel cursor, in all panes</dd></div>
        <div><dt>wheel</dt><dd>zoom; far in, pixels show letters and numbers</dd></div>
        <div><dt>drag</dt><dd>move the picture, or the line between A and B</dd></div>
        <div><dt>Move, drag</dt><dd>an object, parallel to the image; with Shift along the ray, with Ctrl it turns; Alt and wheel scale it</dd></div>
        <div><dt>Shift and drag</dt><dd>statistics of a rectangle</dd></div>
        <div><dt>Alt and drag</dt><dd>a region: why is it wrong?</dd></div>
        <div><dt>in 3D</dt><dd>drag: turn; right button, or Shift: move; wheel, or two fingers: nearer; click: choose an object</dd></div>
        <div><dt>drop</dt><dd>a screenshot of the viewer: the state that is in it</dd></div>
        <div><dt>click</dt><dd>all there is to know of a pixel; a raw frame of the sheet is enlarged</dd></div>
      </dl>
      <label class="check">
        <input type="checkbox" checked={letter_keys.value} onChange={(event) => set_letter_keys(event.currentTarget.checked)} />
        Keys of one letter, digit or sign act
      </label>
      <p class="faint">
        tofray {hello.value?.version ?? ""}.{!TOFRAY_IN_FILE && <> <a href="THIRD-PARTY.txt">Software of others in this page</a>.</>}
      </p>
      {TOFRAY_IN_FILE && <details><summary>Software of others in this page</summary><pre class="licences" tabIndex={0} role="region" aria-label="Licences">{document.getElementById("tofray-licences")?.textContent ?? ""}</pre></details>}
    </Dialog>
  );
}
