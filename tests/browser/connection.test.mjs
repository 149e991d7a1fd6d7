// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// A hidden page costs nothing, and a connection that breaks is told and mended where it can be.

import assert from "node:assert/strict";
import { open, proxy, shown, stand_at, test, until, view } from "./viewer.mjs";

const words = ["demo", "--seed", "5"];
const drawn = ({ page }) => page.evaluate(() => window.tofray.counters.drawn);

/** The tab goes into the background and comes back, as the page is told of it. */
const hide = ({ page }, hidden) => page.evaluate((to) => {
  Object.defineProperty(document, "hidden", { configurable: true, get: () => to });
  document.dispatchEvent(new Event("visibilitychange"));
}, hidden);

test("for a hidden page no frame is computed; when it comes back it goes on with the next one", async () => {
  const { url } = await view([...words, "--rate", "max"]);
  const tab = await shown(url);
  const { page } = tab;
  await page.getByRole("combobox", { name: "Frames per second" }).selectOption("max");
  const watcher = await open(url);   // is told how many were computed
  await watcher.page.waitForFunction(() => window.tofray?.stats !== undefined);
  const computed = () => Math.max(...watcher.texts.filter((one) => one.type === "stats").map((one) => one.computed));
  const before_playing = computed();
  await page.waitForFunction((from) => window.tofray.counters.drawn >= from + 5, await drawn(tab));
  await watcher.page.waitForTimeout(1500);   // (numbers come once a second)
  assert.ok(computed() > before_playing, "nothing was computed while both were looked at");

  for (const one of [tab, watcher]) await hide(one, true);
  const standing = async (milliseconds) => {
    const [from, end] = [computed(), performance.now() + milliseconds];
    while (performance.now() < end) {
      await watcher.page.waitForTimeout(50);
      if (computed() !== from) return false;
    }
    return true;
  };
  let tries = 0;
  while (!await standing(2000)) assert.ok(++tries < 10, `${computed()} frames were computed`);   // (what was under way comes to its end)
  const still = { drawn: await drawn(tab), frames: tab.frames.length };
  assert.ok(await standing(3000));
  assert.equal(await drawn(tab), still.drawn);

  await hide(tab, false);
  await page.waitForFunction((from) => window.tofray.counters.drawn > from, still.drawn);
  const [before, next] = tab.frames.slice(still.frames - 1);
  assert.ok(next >= before && next <= computed(), `frame ${before}, then ${next} of ${computed()}`);
});

/** Keeps how long the page's timers wait: with nobody to talk to, those of its tries alone. */
const notes_waits = (page) => page.addInitScript(() => {
  window.waits = [];
  const wait = window.setTimeout;
  window.setTimeout = (...words) => (window.waits.push(words[1]), wait(...words));
});

test("a server that was killed is told; another one in its place needs its own address; the page is not loaded again", async () => {
  const first = await view(words);
  const tab = await shown(first.url, { before: notes_waits });
  const { page } = tab;
  await stand_at(tab, 2);
  await first.kill();
  const alert = page.getByRole("alert");
  await alert.getByText("The server is gone.").waitFor();
  assert.match(await alert.textContent(), /started again, prints a new address: open that one, its key is another/);
  assert.equal(await page.getByRole("status").first().textContent(), "no server");
  assert.equal(await page.getByRole("button", { name: "Play" }).isDisabled(), true);
  assert.equal(await page.evaluate(() => window.tofray.pane(0).width), 224, "the last picture is gone");
  const tries = await page.evaluate(() => window.waits.length);
  await page.waitForFunction((from) => window.waits.length >= from + 2, tries);
  const [one, next] = await page.evaluate((from) => window.waits.slice(from), tries);
  assert.ok(one >= 500 && next > one, `waits ${one} ms, then ${next} ms`);

  const second = await view(words, first.port);
  await alert.getByText("This address is an old one.").waitFor();
  const last = tab.sockets;
  await page.waitForTimeout(1500);
  assert.equal(tab.sockets, last, "goes on with a key that does not open this server");
  assert.equal(tab.loads, 1);

  await page.goto(second.url);
  await page.waitForFunction(() => window.tofray.playing === true);
  assert.equal(await alert.count(), 0);
  assert.equal(page.url(), second.url.split("#")[0]);
  assert.equal(tab.loads, 1, "its key alone was new");
});

test("a connection that was cut is opened again, with all that was asked for", async () => {
  const line = await proxy();
  const { url, port } = await view([...words, "--allow-host", `127.0.0.1:${line.port}`]);
  line.lead_to(port);
  const tab = await shown(`http://127.0.0.1:${line.port}/${new URL(url).hash}`);
  const { page } = tab;
  for (let i = 0; i < 3; ++i) {
    const sockets = tab.sockets;
    const hellos = tab.texts.filter((one) => one.type === "hello").length;
    line.cut();
    await until(() => tab.texts.filter((one) => one.type === "hello").length > hellos, "a greeting on a new line");
    await page.waitForFunction((from) => window.tofray.counters.drawn > from + 1, await drawn(tab));
    assert.equal(await page.getByRole("alert").count(), 0);
    assert.equal(tab.sockets, sockets + 1);
  }
  assert.deepEqual(await page.evaluate(() => window.alerts), Array(3).fill("The connection is lost."));
  assert.equal(tab.loads, 1);
});
