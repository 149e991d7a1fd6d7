// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Objects dragged in a picture, by pointer and by keys: what is asked, that it becomes a change like any other, and that the thing is there then.

import assert from "node:assert/strict";
import { between, point_at, rendered, settled, shown, stand_at, test, until, view, written } from "./viewer.mjs";

const words = ["demo", "--seed", "5"];
const width = 224;

async function ready(all = words, options = {}) {
  const { url } = await view(all);
  const tab = await shown(url, options);
  await stand_at(tab, 0);
  await tab.page.getByRole("button", { name: "Move", exact: true }).click();
  await tab.page.waitForFunction(() => document.querySelector("main").classList.contains("drags"));
  await until(() => tab.asked.filter((one) => one.type === "want").at(-1).arrays.includes("gt_object_id"), "objects' numbers");
  await until(() => tab.last.a !== undefined && arrays_of(tab).includes("gt_object_id"), "a frame with them");
  await tab.page.evaluate(() => new Promise((then) => requestAnimationFrame(() => requestAnimationFrame(then))));
  return tab;
}

function arrays_of({ last, hello }) {
  const message = last.a;
  return Array.from({ length: message.readUInt16LE(44) }, (_, i) => hello().arrays[message.readUInt16LE(message.readUInt16LE(4) + 32 * i)].name);
}

async function drag(tab, from, ways, { key, hold } = {}) {
  const { page } = tab;
  await point_at(tab, ...from);
  if (key !== undefined) await page.keyboard.down(key);
  await page.mouse.down();
  for (const to of ways) await point_at(tab, ...to);
  await hold?.();
  await page.mouse.up();
  if (key !== undefined) await page.keyboard.up(key);
  await settled(tab);
}

/** Of A: what would make this state by the command. */
const settings = (overrides) => overrides.flatMap(({ key, text }) => ["--set", `${key}=${text}`]);
const overrides = ({ page }) => page.evaluate(() => window.tofray.overrides);
const steps = ({ page }) => page.evaluate(() => window.tofray.steps.past);

/** The gesture has ended. */
const rested = (tab) => tab.page.waitForTimeout(200);

test("a drag of a ball by 20 pixels: what is seen there then is the ball; it is one step of undo, and undone it is where it was", async () => {
  const tab = await ready();
  const before = rendered(words);
  const at = 145 * width + 55;
  const ball = before.gt_object_id.values[at];
  assert.notEqual(before.gt_object_id.values[at - 20], ball);
  await drag(tab, [55, 145], [[52, 145], [46, 145], [40, 146], [35, 145]]);
  await rested(tab);
  const changed = await overrides(tab);
  assert.equal(changed.length, 1);
  assert.match(changed[0].key, new RegExp(`^objects\\.${ball}\\.`));
  const after = rendered([...words, ...settings(changed)]);
  assert.equal(after.gt_object_id.values[at - 20], ball, "the ball is where the pointer let go");
  // Parallel to the image: as far away as before (to the micrometre that positions have).
  assert.ok(Math.abs(after.gt_z_m.values[at - 20] - before.gt_z_m.values[at]) < 2e-3, `${after.gt_z_m.values[at - 20]}, before ${before.gt_z_m.values[at]}`);
  const drags = tab.asked.filter((one) => one.type === "drag");
  assert.ok(drags.every((one) => one.how === "parallel" && one.object === ball && one.base === drags[0].base && String(one.from) === "55,145"), JSON.stringify(drags));
  assert.equal(await steps(tab), 1);
  await tab.page.keyboard.press("Control+z");
  await tab.page.waitForFunction(() => window.tofray.overrides.length === 0);
  await settled(tab);
  assert.deepEqual(tab.troubles, []);
});

test("one move is on its way at a time: whatever the pointer does, each is asked with the gesture's first state, the last one last", async () => {
  const tab = await ready();
  const ways = Array.from({ length: 40 }, (_, i) => [66 + i / 2, 145]);
  await drag(tab, [66, 145], ways);
  await rested(tab);
  const drags = tab.asked.filter((one) => one.type === "drag");
  assert.ok(drags.length < 40, `${drags.length} of 40 moves are asked`);
  assert.ok(Math.abs(drags.at(-1).to[0] - 85.5) < 0.3, `the last one is to ${drags.at(-1).to}`);
  // Never a second one before the first is answered, set, and done.
  const turn = ["page drag", "server drag", "page state", "server done"];
  const order = tab.talk.filter((one) => turn.includes(one));
  order.forEach((one, i) => assert.equal(one, turn[i % 4], order.join()));
  assert.equal(await steps(tab), 1);
});

for (const [key, how, to, check] of [
  ["Shift", "along", [66, 125], (before, after) => after.gt_z_m.values[145 * width + 66] / before.gt_z_m.values[145 * width + 66] > 1.1],
  ["Control", "turn", [80, 145], () => true],
]) {
  test(`with ${key} a drag says ${how}`, async () => {
    const box = written("box.yaml", [
      "camera: {profile: pico-flexx, mode: MODE_9_5FPS_2000}", "objects:",
      "  - plane: {name: wall, point: [0, 0, 2], normal: [0, 0, -1], reflectivity: 0.8}",
      "  - box: {name: crate, min: [-0.4, 0.15, 0.8], max: [-0.15, 0.45, 0.9], reflectivity: 0.5}", "",
    ].join("\n"));
    const all = [box, "--seed", "5"];
    const tab = await ready(all);
    await drag(tab, [66, 145], [[66, 140], to], { key });
    await rested(tab);
    const drags = tab.asked.filter((one) => one.type === "drag");
    assert.ok(drags.length > 0 && drags.every((one) => one.how === how), JSON.stringify(drags));
    const changed = await overrides(tab);
    assert.ok(changed.length > 0);
    const [before, after] = [rendered(all), rendered([...all, ...settings(changed)])];
    assert.ok(check(before, after), JSON.stringify(changed));
    assert.equal(await steps(tab), 1);
    if (how === "turn") assert.ok(changed.some((one) => one.key.endsWith("rotation")), JSON.stringify(changed));
  });
}

test("Alt and the wheel make an object smaller; steps that follow each other are one gesture", async () => {
  const tab = await ready();
  const { page } = tab;
  await point_at(tab, 66, 145);
  await page.keyboard.down("Alt");
  for (let i = 0; i < 3; ++i) await page.mouse.wheel(0, 100);
  await page.keyboard.up("Alt");
  await page.waitForFunction(() => window.tofray.overrides.some((one) => one.key.endsWith("radius")));
  await settled(tab);
  await page.waitForTimeout(800);
  const drags = tab.asked.filter((one) => one.type === "drag");
  assert.ok(drags.every((one) => one.how === "scale" && one.base === drags[0].base), JSON.stringify(drags));
  assert.equal(await steps(tab), 1);
  const ids = (frame) => frame.gt_object_id.values.filter((one) => one === drags[0].object).length;
  const [before, after] = [ids(rendered(words)), ids(rendered([...words, ...settings(await overrides(tab))]))];
  assert.ok(after < 0.85 * before, `${after} pixels of ${before}`);
  assert.equal(await page.evaluate(() => window.tofray.placement(0).scale), 2, "the picture is not zoomed");
});

test("by keys: Enter takes the object under the cursor, arrow keys move it, with Ctrl they turn it, plus makes it larger, Enter lets go", async () => {
  const tab = await ready();
  const { page } = tab;
  await page.locator(".stage").first().focus();
  await point_at(tab, 66, 145);
  await page.keyboard.press("Enter");
  for (let i = 0; i < 4; ++i) await page.keyboard.press("ArrowRight");
  await until(() => tab.asked.some((one) => one.type === "drag" && one.to[0] === 70), "the fourth move");
  await settled(tab);
  assert.equal(await page.locator(".read-out dd").first().textContent(), "70, 145");
  await page.waitForTimeout(300);
  await page.keyboard.press("+");
  await until(() => tab.asked.some((one) => one.type === "drag" && one.how === "scale"), "a larger one");
  await settled(tab);
  await page.keyboard.press("Enter");
  await rested(tab);
  const changed = await overrides(tab);
  assert.deepEqual(changed.map((one) => one.key.split(".").at(-1)).sort(), ["position", "radius"]);
  assert.equal(await page.evaluate(() => window.tofray.placement(0).scale), 2, "the picture is not zoomed");
  // Let go, arrow keys move the cursor alone.
  const asked = tab.asked.filter((one) => one.type === "drag").length;
  await page.keyboard.press("ArrowRight");
  await page.keyboard.press("d");
  assert.equal(tab.asked.filter((one) => one.type === "drag").length, asked);
  assert.equal(await page.evaluate(() => document.querySelector("main").classList.contains("drags")), false);
});

test("what cannot be moved says why, and nothing is changed", async () => {
  const scene = written("moving.yaml", [
    "camera: {profile: pico-flexx, mode: MODE_9_5FPS_2000}", "objects:",
    "  - plane: {name: wall, point: [0, 0, 2], normal: [0, 0, -1], reflectivity: 0.8}",
    "  - sphere: {name: ball, center: [0, 0, 1], radius: 20 cm, reflectivity: 0.5, keyframes: [{time: 0 s, position: [0, 0, 0]}, {time: 1 s, position: [0.5, 0, 0]}]}", "",
  ].join("\n"));
  const tab = await ready([scene, "--seed", "5"]);
  await drag(tab, [112, 86], [[116, 86], [122, 86]]);
  const alert = tab.page.getByRole("alert");
  await alert.waitFor();
  assert.match(await alert.textContent(), /keyframes/);
  assert.deepEqual(await overrides(tab), []);
  assert.equal(await steps(tab), 0);
});

test("an answer is set in the list's own order: keys that are there keep their place, what is to go goes", async () => {
  const answer = { drag: ({ id, base }) => ({ type: "drag", id, base, sets: [{ key: "camera.lens.f_number", text: "2.5" }, { key: "camera.pixel.full_well", text: "90000 e" }], unsets: ["camera.lens.transmission"], what: "<b>moved</b>" }) };
  const sent = [];
  const { url } = await view([...words, ...["lens.f_number=2", "lens.transmission=0.8", "adc.bits=12"].flatMap((one) => ["--set", `camera.${one}`])]);
  const tab = await shown(url, { before: between({ asked: { ...answer, state: (of) => void sent.push(of) } }) });
  await stand_at(tab, 0);
  const { page } = tab;
  await page.getByRole("button", { name: "Move", exact: true }).click();
  await until(() => tab.last.a !== undefined && arrays_of(tab).includes("gt_object_id"), "a frame with objects' numbers");
  await page.evaluate(() => new Promise((then) => requestAnimationFrame(() => requestAnimationFrame(then))));
  await drag(tab, [66, 145], [[70, 145], [80, 145]], { hold: () => page.locator(".moved").waitFor() });
  assert.equal(await page.locator(".moved").textContent(), "moved: <b>moved</b>");
  assert.deepEqual(sent.at(-1).overrides, [{ key: "camera.lens.f_number", text: "2.5" }, { key: "camera.adc.bits", text: "12" }, { key: "camera.pixel.full_well", text: "90000 e" }]);
  assert.equal(await page.locator("b").count(), 0);
});

test("without the tool a drag moves nothing, and no object's number is sent", async () => {
  const { url } = await view(words);
  const tab = await shown(url);
  await stand_at(tab, 0);
  await drag(tab, [66, 145], [[76, 145], [86, 145]]);
  assert.deepEqual(tab.asked.filter((one) => one.type === "drag"), []);
  assert.ok(!tab.asked.filter((one) => one.type === "want").at(-1).arrays.includes("gt_object_id"));
});
