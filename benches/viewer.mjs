// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// How quick the viewer is, server and page on one machine: from a slider to the picture, frames drawn a second, the first draft of a frame
// whose light bounces, what a changed key takes, and what an idle viewer takes. Every figure stands beside the processor's time that it took,
// which other work on the machine changes less than the clock:
//   TOFRAY=build/release/apps/tofray/tofray TOFRAY_PAGE_PACKAGES=build/release/viewer node benches/viewer.mjs [ROUNDS] [SECONDS]

import { readFileSync, readdirSync } from "node:fs";
import { loadavg } from "node:os";
import { bare_browser } from "../tests/browser/bare.mjs";
import { test, told, view } from "../tests/browser/viewer.mjs";

const rounds = Number(process.argv[2] ?? 60);
const seconds = Number(process.argv[3] ?? 8);

// --- Numbers ---

const sorted = (values) => [...values].sort((a, b) => a - b);
const quantile = (values, q) => sorted(values)[Math.min(values.length - 1, Math.ceil(q * values.length) - 1)];
const median = (values) => quantile(values, 0.5);
const both = (values) => `${median(values).toFixed(0)} / ${quantile(values, 0.95).toFixed(0)} ms`;

/** Processor time of all processes that this one has started, in seconds: of tofray, and of the browser. */
function processor_time() {
  const processes = new Map();
  for (const pid of readdirSync("/proc").filter((name) => /^\d+$/.test(name))) {
    try {
      const stat = readFileSync(`/proc/${pid}/stat`, "latin1");
      const rest = stat.slice(stat.lastIndexOf(")") + 2).split(" ");
      processes.set(Number(pid), { parent: Number(rest[1]), ticks: Number(rest[11]) + Number(rest[12]), name: stat.slice(stat.indexOf("(") + 1, stat.lastIndexOf(")")) });
    } catch { /* it has ended meanwhile */ }
  }
  const ours = (pid) => pid === process.pid || (processes.has(pid) && ours(processes.get(pid).parent));
  const sum = { server: 0, browser: 0 };
  for (const [pid, { ticks, name }] of processes) {
    if (pid !== process.pid && ours(pid)) sum[name === "tofray" ? "server" : "browser"] += ticks / 100;
  }
  return sum;
}

/** What a stretch of time takes of the processors, in seconds. */
async function taken(during) {
  const [before, from] = [processor_time(), performance.now()];
  await during();
  const [after, to] = [processor_time(), performance.now()];
  return { server: after.server - before.server, browser: after.browser - before.browser, seconds: (to - from) / 1000 };
}

// --- The machine ---

/** A frame of bench-primitives on all processors, and a loop of JavaScript: what the same takes on another day, and beside other work. */
function calibration() {
  const bench = JSON.parse(told(["bench", "--frames", "60", "--json"], { stdio: ["ignore", "pipe", "ignore"] })).results[0];
  const loops = Array.from({ length: 9 }, () => {
    const from = performance.now();
    let x = 1;
    for (let i = 0; i < 2e7; ++i) x = (x * 1.0000001 + i) % 1e6;
    return performance.now() - from + 0 * x;
  });
  return `bench-primitives ${bench.ms_median.toFixed(2)} ms, its simulator anew for another lens ${bench.set_up_ms.another_lens.toFixed(1)} ms, for another number of the sensor ${bench.set_up_ms.another_sensor_number.toFixed(1)}, a loop of JavaScript ${median(loops).toFixed(0)} ms (least ${Math.min(...loops).toFixed(0)}), load ${loadavg()[0].toFixed(1)}`;
}

/** What a move or a frame takes of the processors. */
const processors = (spent, count) => `processors ${(1000 * spent.server / count).toFixed(1)} ms server, ${(1000 * spent.browser / count).toFixed(1)} ms browser`;

const row = (what, measured, more = "") => console.log(`| ${what} | ${measured} | ${more} |`);

// --- In the page ---

/** Runs before the page's own scripts: notes when messages go and come, and when what came was drawn; has the hands of somebody at the page. */
function prepare() {
  const notes = (window.notes = []);
  window.WebSocket = class extends WebSocket {
    constructor(...words) {
      super(...words);
      this.addEventListener("message", ({ data }) => {
        const at = performance.now();
        if (typeof data === "string") {
          if (data.includes('"type":"done"')) notes.push({ what: "done", at });
          return;
        }
        const head = new DataView(data);
        if (head.getUint8(6) < 2) notes.push({ what: "came", at, generation: head.getUint32(8, true), draft: (head.getUint8(7) & 1) === 1, computed: head.getFloat32(48, true) });
        if (notes.length > 1000) notes.length = 0;
      });
    }
    send(text) {
      if (text.includes('"type":"set"')) notes.push({ what: "sent", at: performance.now() });
      super.send(text);
    }
  };
  const real = window.requestAnimationFrame.bind(window);
  let drawn;
  window.requestAnimationFrame = (then) => real((time) => {
    then(time);
    const last = window.tofray?.last;
    if (last === undefined || (drawn?.generation === last.generation && drawn.draft === last.draft)) return;
    drawn = last;
    notes.push({ what: "drawn", at: performance.now(), generation: last.generation, draft: last.draft });
  });
  const put = (element, value, event) => {
    element.value = String(value);
    element.dispatchEvent(new Event(event, { bubbles: true }));
  };
  const slider_of = (key) => document.querySelector(`.control[data-key="${key}"] input[type=range]`);
  window.hands = {
    click: (name) => document.querySelector(`button[aria-label="${name}"]`).click(),
    choose: (selector, value) => put(document.querySelector(selector), value, "change"),
    search: (key) => put(document.querySelector("#search"), key, "input"),
    slider: slider_of,
    /** Moves a slider to a place between 0 and 1, and waits until the frame of it is drawn. @return  ms from the move to each step */
    slide: async (key, place) => {
      const slider = slider_of(key);
      const before = window.tofray.last.generation;
      notes.length = 0;
      const from = performance.now();
      put(slider, Math.round(place * Number(slider.max)), "input");
      const found = (what, draft) => notes.find((one) => one.what === what && (one.generation === undefined || (one.generation > before && one.draft === draft)));
      while (found("drawn", false) === undefined) {
        if (performance.now() > from + 60_000) throw new Error("no picture in a minute");
        await new Promise((then) => setTimeout(then, 5));
      }
      const ms = (what, draft = false) => { const one = found(what, draft); return one === undefined ? null : one.at - from; };
      return { sent: ms("sent"), done: ms("done"), came: ms("came"), drawn: ms("drawn"), draft: ms("drawn", true), computed: found("came", false).computed };
    },
  };
}

/** A page of a viewer of its own. @param args  of the browser */
async function opened(words, args) {
  const viewer = await view(words);
  const browser = await bare_browser(args);
  return { page: await browser.page(viewer.url, prepare), end: () => Promise.all([browser.close(), viewer.kill()]) };
}

const pause_ms = (ms) => new Promise((then) => setTimeout(then, ms));

/** A slider is moved so many times, each time to another place; time stands still. */
async function slid(words, key, count) {
  const { page, end } = await opened([...words, "--seed", "1"]);
  await page.evaluate(() => window.hands.click("Pause"));
  await page.wait(() => window.tofray.playing === false);
  await page.evaluate((of) => window.hands.search(of), key);
  await page.wait((of) => window.hands.slider(of) !== null, key);
  await pause_ms(500);
  const all = [];
  let spent;
  for (const warm of [true, false]) {
    spent = await taken(async () => {
      for (let i = 0; i < (warm ? 5 : count); ++i) {
        const ms = await page.evaluate((of, place) => window.hands.slide(of, place), key, 0.3 + 0.4 * ((i * 0.618) % 1) + (warm ? 0.01 : 0));
        if (!warm) all.push(ms);
        await pause_ms(20 + 30 * ((i * 0.414) % 1));
      }
    });
  }
  await end();
  return { spent, of: (name) => all.map((one) => one[name]), from: (first, last) => all.map((one) => one[last] - one[first]) };
}

// --- What is measured ---

test("calibration", () => void console.log(`\n${calibration()}\n\n| what | measured | of it |\n|---|---|---|`));

for (const [scene, key] of [["demo", "camera.lens.f_number"], ["demo", "objects.2.sphere.radius"], ["room", "camera.lens.f_number"], ["bench-mesh", "camera.lens.f_number"]]) {
  test(`slider to picture: ${scene}, ${key}`, async () => {
    const { spent, of, from } = await slid([scene], key, rounds);
    row(`slider to picture, ${scene}, \`${key}\``, both(of("drawn")),
      `sent to done, which is the new simulator, ${both(from("sent", "done"))}; frame computed in ${both(of("computed"))}; come to drawn ${both(from("came", "drawn"))}; ${processors(spent, rounds)}`);
  });
}

for (const scene of ["corner", "room"]) {
  test(`first draft: ${scene}`, async () => {
    const count = Math.ceil(rounds / 4);
    const { spent, of } = await slid([scene, "--bounces", "7"], "camera.lens.f_number", count);
    row(`first draft of a frame of 7 bounces, ${scene}`, both(of("draft")), `the frame itself ${both(of("drawn"))}; ${processors(spent, count)}`);
  });
}

const unlimited = ["--disable-gpu", "--disable-software-rasterizer", "--disable-frame-rate-limit", "--disable-gpu-vsync"];

for (const [name, words] of [["224 × 172, pico flexx", ["demo"]], ["640 × 480, imx556", ["imx556"]]]) {
  for (const args of [undefined, unlimited]) {
    test(`frames drawn: ${name}`, async () => {
      const { page, end } = await opened(words, args);
      await page.evaluate(() => window.hands.choose(".rate select", "max"));
      await pause_ms(2000);
      const counts = () => page.evaluate(() => ({ ...window.tofray.counters, ...window.tofray.stats }));
      const before = await counts();
      const spent = await taken(() => pause_ms(1000 * seconds));
      const after = await counts();
      const frames = after.drawn - before.drawn;
      row(`frames drawn a second, ${name}, two panes${args === undefined ? "" : ", a browser that waits for no screen"}`, `${(frames / spent.seconds).toFixed(1)}/s`,
        `computed ${((after.computed - before.computed) / spent.seconds).toFixed(1)}/s; ${processors(spent, frames)}`);
      await end();
    });
  }
}

test("idle", async () => {
  const { page, end } = await opened(["demo"]);
  const share = async (what) => {
    await pause_ms(3000);
    const spent = await taken(() => pause_ms(1000 * seconds));
    row(`idle: ${what}`, `server ${(100 * spent.server / spent.seconds).toFixed(1)} % of a core`, `browser ${(100 * spent.browser / spent.seconds).toFixed(1)} %`);
  };
  await share("a page that plays at its camera's 5 frames/s");
  await page.evaluate(() => window.hands.click("Pause"));
  await page.wait(() => window.tofray.playing === false);
  await share("a page that stands still");
  await page.evaluate(() => {
    window.hands.click("Play");
    Object.defineProperty(document, "hidden", { configurable: true, get: () => true });
    document.dispatchEvent(new Event("visibilitychange"));
  });
  await share("a hidden page of a viewer that plays");
  await end();
});

test("calibration again", () => void console.log(`\n${calibration()}`));
