// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// A tutorial that is done in the viewer, done as it says. Before a paragraph, what somebody does who reads it: <!-- page: ONE; ANOTHER … -->.
// What is bold in the paragraph is then the name of something on the page, and what is slanted is to be read there.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { beside, choose, drawn, point_at, set, settled, shown, stand_at, view } from "./viewer.mjs";

const hands = {
  frame: (tab, [number]) => stand_at(tab, Number(number)),
  panes: ({ page }, [count]) => page.getByRole("combobox", { name: "Number of panes" }).selectOption(count),
  choose: (tab, [pane, array]) => choose(tab, Number(pane) - 1, array),
  fit: ({ page }, [pane]) => page.locator(".pane").nth(Number(pane) - 1).getByText("Fit", { exact: true }).click(),
  search: ({ page }, words) => page.getByRole("searchbox", { name: "Search the controls" }).fill(words.join(" ")),
  set: (tab, [key, ...text]) => set(tab, key, text.join(" ")),
  point: (tab, [place]) => point_at(tab, ...place.split(",").map(Number)),
  press: async ({ page }, [key]) => {
    await page.locator(".stage").first().focus();
    await page.keyboard.press(key);
  },
  click: ({ page }, words) => page.getByRole("button", { name: words.join(" "), exact: true }).first().click(),
  tab: (tab, words) => beside(tab, words.join(" ")),
  why: ({ page }) => page.waitForFunction(() => {
    const panel = document.querySelector(".why-panel");
    return panel?.getAttribute("aria-busy") === "false" && panel.querySelector("[data-why-of]:not(.late)") !== null;
  }),
  pixel: ({ page }, [place]) => page.locator(`.answer[data-pixel="${place}"]`).waitFor(),
  shows: (tab, [what]) => drawn(tab, what),
  settled: (tab) => settled(tab),
};

/** All that a document has in turn: {line, words: of `tofray view`} or {line, doing, names, figures, picture}. */
export function steps_of(path) {
  const steps = [];
  let line = 1;
  for (const block of readFileSync(path, "utf8").split("\n\n")) {
    const [, command] = /^```sh\ntofray view ([^\n#]*)/m.exec(block) ?? [];
    const comment = /^<!-- page: (.*?) -->\n/s.exec(block)?.[1];
    const text = block.replaceAll("\n", " ").replace(/<!--.*?-->/g, "").replace(/`[^`]*`/g, "");
    if (command !== undefined) steps.push({ line, words: command.trim().split(/\s+/) });
    else if (steps.length > 0 && !block.startsWith("```") && !block.startsWith("#")) {
      steps.push({
        line, doing: comment?.split(";").map((one) => one.trim().split(/\s+/)) ?? [],
        picture: /^!\[.*\]\(images\/(.*?)\)$/s.exec(block)?.[1],
        names: [...text.matchAll(/\*\*(.+?)\*\*/g)].map(([, name]) => name),
        figures: [...text.replace(/\*\*.+?\*\*/g, "").matchAll(/\*(.+?)\*/g)].map(([, figure]) => figure),
      });
    }
    line += block.split("\n").length + 1;
  }
  return steps;
}

/** Names of what is on the page, and all that is to be read, in plain spaces. */
const read = ({ page }) => page.evaluate(() => {
  const plain = (text) => text.replace(/\s+/g, " ").trim();
  const names = new Set();
  for (const one of document.querySelectorAll("button, option, [role=tab], label, summary, h2, h3, strong, th, input, select, .unseen"))
    for (const text of [one.ariaLabel, one.textContent, one.value]) if (text) names.add(plain(String(text)));
  return { names: [...names], text: plain(document.body.innerText) };
});

/** Does a document's steps in one tab. @param picture  is called where the document has one: (tab, its name) */
export async function follow(path, { picture = () => undefined, ...options } = {}) {
  let tab;
  for (const { line, words, doing, names, figures, picture: name } of steps_of(path)) {
    if (words !== undefined) {
      tab = await shown((await view(words)).url, options);
      continue;
    }
    for (const [what, ...more] of doing) {
      assert.ok(what in hands, `${path}, line ${line}: ${what}`);
      await hands[what](tab, more);
    }
    const seen = await read(tab);
    for (const one of names) assert.ok(seen.names.includes(one), `${path}, line ${line}: nothing on the page is called "${one}"`);
    for (const one of figures) assert.ok(seen.text.includes(one.replaceAll("−", "\u2212")), `${path}, line ${line}: "${one}" is not on the page, which says: ${seen.text}`);
    if (name !== undefined) await picture(tab, name);
  }
  assert.ok(tab !== undefined, `${path} opens no viewer`);
  return tab;
}
