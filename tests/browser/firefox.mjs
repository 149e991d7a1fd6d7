// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// The page in Firefox (Debian: firefox-esr), by WebDriver BiDi, for Playwright drives only a Firefox of its own: it loads, its depth has the
// colours of what `render` writes, a slider's last place is what is shown, and nobody complains. Not among the tests: .ci/long runs it.
//   TOFRAY=… TOFRAY_PAGE_PACKAGES=… node tests/browser/firefox.mjs

import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { mkdtempSync } from "node:fs";
import { createRequire } from "node:module";
import { join, resolve } from "node:path";
import { createInterface } from "node:readline";
import { expected, scale_of } from "./colors.mjs";
import { folder, rendered, same, test, until, view } from "./viewer.mjs";

const { ws: WebSocket } = createRequire(resolve(process.env.TOFRAY_PAGE_PACKAGES, "package.json"))("playwright-core/lib/utilsBundle");

/** @return {told: what the console has, evaluate, close} */
async function firefox(url, before) {
  const child = spawn("firefox-esr", ["--headless", "--remote-debugging-port", "0", "--profile", mkdtempSync(join(folder, "firefox-")), "--no-remote", "--window-size=1280,900"],
    { stdio: ["ignore", "ignore", "pipe"], env: { ...process.env, HOME: folder } });
  const close = () => void child.kill("SIGKILL");
  let address;
  createInterface({ input: child.stderr }).on("line", (line) => (address ??= /WebDriver BiDi listening on (ws:\S+)/.exec(line)?.[1]));
  await until(() => address !== undefined || child.exitCode !== null, "Firefox to say where it listens");
  assert.ok(address !== undefined, "Firefox ended");
  const line = new WebSocket(`${address}/session`);
  await new Promise((then, fail) => line.on("open", then).on("error", fail));
  const answers = new Map();
  const told = [];
  line.on("message", (text) => {
    const message = JSON.parse(text);
    if (message.method === "log.entryAdded" && ["error", "warn"].includes(message.params.level)) told.push(message.params.text);
    answers.get(message.id)?.(message);
  });
  let last = 0;
  const send = async (method, params) => {
    const id = ++last;
    const answer = await new Promise((then) => (answers.set(id, then), line.send(JSON.stringify({ id, method, params }))));
    if (answer.type !== "success") throw new Error(`${method}: ${answer.error}: ${answer.message}`);
    return answer.result;
  };
  await send("session.new", { capabilities: {} });
  await send("session.subscribe", { events: ["log.entryAdded"] });
  await send("script.addPreloadScript", { functionDeclaration: String(before) });
  const { contexts: [{ context }] } = await send("browsingContext.getTree", {});
  await send("browsingContext.navigate", { context, url, wait: "complete" });
  /** What a function of the page's returns, as JSON has it. */
  const evaluate = async (run, ...words) => {
    const { result, exceptionDetails } = await send("script.evaluate", {
      expression: `(async () => JSON.stringify(await (${run})(...${JSON.stringify(words)})))()`, target: { context }, awaitPromise: true,
    });
    if (exceptionDetails !== undefined) throw new Error(exceptionDetails.text);
    return result.value === undefined ? undefined : JSON.parse(result.value);
  };
  const wait = async (holds, ...words) => {
    for (const end = performance.now() + 60_000; !(await evaluate(holds, ...words));) {
      if (performance.now() > end) throw new Error(`waited 60 s for ${holds}`);
      await new Promise((again) => setTimeout(again, 50));
    }
  };
  return { told, evaluate, wait, close };
}

/** Runs before the page's own scripts: keeps what the server greets with, and what the content policy refuses. */
function keep_what_comes() {
  window.violations = [];
  document.addEventListener("securitypolicyviolation", (event) => window.violations.push(`${event.violatedDirective}: ${event.blockedURI}`));
  window.WebSocket = class extends WebSocket {
    constructor(...words) {
      super(...words);
      this.addEventListener("message", ({ data }) => {
        if (typeof data === "string" && data.startsWith('{"type":"hello"')) window.greeting = data;
      });
    }
  };
}

test("in Firefox the page loads, shows depth in its colours, follows a slider, and reports nothing", async () => {
  const words = ["demo", "--seed", "5"];
  const { url } = await view(words);
  const page = await firefox(url, keep_what_comes);
  try {
    await page.wait(() => window.tofray?.counters.drawn > 0);
    await page.evaluate(() => document.querySelector('button[aria-label="Pause"]').click());
    await page.wait(() => window.tofray.playing === false);
    const put = (selector, value, events) => {
      const element = document.querySelector(selector);
      element.value = value;
      for (const event of events) element.dispatchEvent(new Event(event, { bubbles: true }));
    };
    await page.evaluate(put, "#frame", "0", ["input"]);
    await page.evaluate(() => document.querySelector("form.frame-field").requestSubmit());
    await page.wait(() => window.tofray.last?.frame === 0);
    await page.evaluate(() => new Promise((then) => requestAnimationFrame(() => requestAnimationFrame(then))));

    const of = rendered(words);
    const greeting = JSON.parse(await page.evaluate(() => window.greeting));
    const colors = expected(greeting, scale_of(greeting, "z_m"), [...of.z_m.values], of.flags.values);
    same(await page.evaluate(() => Array.from(window.tofray.pane(0).pixels)), colors, "the depth pane");
    // What is on the screen: the middle of each pixel.
    const on_screen = await page.evaluate(() => {
      const { left, top, scale } = window.tofray.placement(0);
      const { width, height } = window.tofray.pane(0);
      const canvas = document.querySelector(".stage canvas.front");
      const all = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
      return Array.from({ length: width * height }, (_, i) => {
        const place = 4 * (Math.floor(top + (Math.floor(i / width) + 0.5) * scale) * canvas.width + Math.floor(left + ((i % width) + 0.5) * scale));
        return Array.from(all.data.subarray(place, place + 4));
      }).flat();
    });
    same(on_screen, colors, "the canvas");

    await page.evaluate(put, "#search", "camera.lens.f_number", ["input"]);
    const slider = '.control[data-key="camera.lens.f_number"] input[type=range]';
    await page.wait((of) => document.querySelector(of) !== null, slider);
    for (let i = 0; i < 20; ++i) await page.evaluate(put, slider, String(400 + 10 * i), ["input"]);
    await page.wait(() => window.tofray.unanswered === 0 && window.tofray.last.generation === window.tofray.generation);
    const [{ key, text }] = await page.evaluate(() => window.tofray.overrides);
    assert.equal(key, "camera.lens.f_number");
    const changed = rendered([...words, "--set", `${key}=${text}`]);
    same(await page.evaluate(() => Array.from(window.tofray.pane(0).pixels)), expected(greeting, scale_of(greeting, "z_m"), [...changed.z_m.values], changed.flags.values), "depth after a drag");
    assert.deepEqual(await page.evaluate(() => window.violations), []);
    assert.deepEqual(page.told, []);
  } finally {
    page.close();
  }
});
