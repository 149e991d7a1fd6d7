// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Points in space, drawn by WebGL and by the processor: where and how they are on the screen is what this file makes of the arrays that the
// command writes, of the rays and of the eye.

import assert from "node:assert/strict";
import { expected, scale_of } from "./colors.mjs";
import { answered_arrays, between, pane, rendered, same, set, settled, shown, stand_at, test, until, view } from "./viewer.mjs";

const words = ["demo", "--seed", "5"];
const width = 224, height = 172;
const ways = [["WebGL", true], ["processor", false]];

const ground = { dark: [13, 15, 18], light: [248, 248, 246] };
const is_ground = (pixels, i, of = ground.dark) => of.every((one, k) => Math.abs(pixels[4 * i + k] - one) <= 1);

/** What the second pane has on the screen: {drawing, eye, width, height, pixels}. */
async function picture({ page }) {
  await page.waitForFunction(() => !["loading", undefined].includes(document.querySelector(".stage.space")?.dataset.drawing) && window.tofray.space(1, false) !== undefined);
  const of = await page.evaluate(() => {
    const { pixels, ...rest } = window.tofray.space(1);
    let text = "";
    for (let i = 0; i < pixels.length; i += 8192) text += String.fromCharCode(...pixels.subarray(i, i + 8192));
    return { ...rest, pixels: btoa(text) };
  });
  return { ...of, pixels: Buffer.from(of.pixels, "base64") };
}

const rgb = ({ pixels }, i) => [pixels[4 * i], pixels[4 * i + 1], pixels[4 * i + 2]];

const last_view = (tab) => tab.texts.findLast((one) => one.type === "view3d");

/** A tab whose second pane shows points coloured by depth, and nothing else of the scene. */
async function points(webgl, { all = words, ...options } = {}) {
  const { url } = await view(all);
  const tab = await shown(url, { webgl, colorScheme: "dark", reducedMotion: "reduce", ...options });
  const { page } = tab;
  await stand_at(tab, 0);
  await page.locator(".pane select.shows").nth(1).selectOption("3D points");
  await page.locator(".pane select.cloud-color").selectOption("z_m");
  await page.locator(".space-options select").first().selectOption("off");
  for (const name of ["Frustum", "Axes"]) await page.getByRole("button", { name, exact: true }).click();
  await until(() => tab.arrays.length > 0, "rays and triangles");
  await page.waitForFunction(([r, g, b]) => {
    const of = window.tofray.space(1)?.pixels;
    return of !== undefined && of.some((one, i) => i % 4 === 0 && (Math.abs(one - r) > 1 || Math.abs(of[i + 1] - g) > 1 || Math.abs(of[i + 2] - b) > 1));
  }, ground[options.colorScheme ?? "dark"], { polling: 100 });   // (the whole picture is read each time)
  const answer = tab.texts.find((one) => one.type === "view3d" && one.static === true);
  return { ...tab, tab, rays: answered_arrays(tab, answer).rays.values, shape: answered_arrays(tab, answer).rays.shape, answer };
}

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

/** Where a pixel's point is on the screen, and how deep in it. */
function place(of, eye, camera, rays, z, i) {
  const own = [z * rays[2 * i], z * rays[2 * i + 1], z];
  const world = camera.rotation.map((row, k) => dot(row, own) + camera.position[k]);
  return seen(of, eye, world);
}

function seen(of, eye, world) {
  const from = world.map((one, k) => one - eye.position[k]);
  const depth = dot(from, eye.forward);
  return {
    x: (of.width * (dot(from, eye.right) / depth - eye.left_edge)) / (eye.right_edge - eye.left_edge),
    y: (of.height * (dot(from, eye.down) / depth - eye.top_edge)) / (eye.bottom_edge - eye.top_edge),
    depth,
  };
}

function box_of(all) {
  const [xs, ys] = [all.map(({ x }) => x), all.map(({ y }) => y)];
  return [Math.min(...xs), Math.min(...ys), Math.max(...xs), Math.max(...ys)];
}

function drawn_places(of) {
  const out = [];
  for (let i = 0; i < of.width * of.height; ++i) if (!is_ground(of.pixels, i)) out.push({ x: (i % of.width) + 0.5, y: Math.floor(i / of.width) + 0.5 });
  return out;
}

function near_box(got, wanted, within, what) {
  got.forEach((one, k) => assert.ok(Math.abs(one - wanted[k]) <= within, `${what}: ${got.map(Math.round)}, expected ${wanted.map(Math.round)}`));
}

for (const [drawing, webgl] of ways) test(`by ${drawing}`, async (t) => {
  const kept = await points(webgl);
  const frame = rendered(words);
  await t.test(`points are where z · ray is seen from, with the colours of their pane; pixels without depth make none`, async () => {
    const { tab, rays, shape } = kept;
    assert.deepEqual(shape, [height, width, 2]);
    const z = frame.z_m.values;
    const of = await picture(tab);
    assert.equal(of.drawing, drawing);
    const { camera } = last_view(tab);
    const all = [...z.keys()].filter((i) => Number.isFinite(z[i])).map((i) => place(of, of.eye, camera, rays, z[i], i)).filter(({ x, y }) => x >= 0 && y >= 0 && x < of.width && y < of.height);
    assert.ok(all.length > 30_000, `${all.length} points are in the picture`);
    const drawn = drawn_places(of);
    near_box(box_of(drawn), box_of(all), 8, "the box around the points");
    assert.ok(drawn.length > 5000, `${drawn.length} places are drawn`);
    // Nothing at the camera itself, where z = 0 would be.
    const at = seen(of, of.eye, camera.position);
    assert.ok(at.x > 10 && at.y > 10 && at.x < of.width - 10 && at.y < of.height - 10, "the camera is in the picture");
    for (let dy = -4; dy <= 4; ++dy) for (let dx = -4; dx <= 4; ++dx) assert.ok(is_ground(of.pixels, Math.floor(at.y + dy) * of.width + Math.floor(at.x + dx)), "a point at the camera");
    // In the colours of depth: nearly all to the bit (WebGL mixes them with the ground at edges).
    const colors = expected(tab.hello(), scale_of(tab.hello(), "z_m"), [...z], frame.flags.values);
    const coarse = (one) => (webgl ? one.map((c) => Math.round(c / 24)) : one);
    const known = new Set([...z.keys()].filter((i) => Number.isFinite(z[i])).flatMap((i) => {
      const [r, g, b] = coarse(colors.slice(4 * i, 4 * i + 3));
      return webgl ? [-1, 0, 1].flatMap((x) => [-1, 0, 1].flatMap((y) => [-1, 0, 1].map((w) => [r + x, g + y, b + w].join()))) : [[r, g, b].join()];
    }));
    const right = drawn.filter(({ x, y }) => known.has(coarse(rgb(of, Math.floor(y) * of.width + Math.floor(x))).join())).length / drawn.length;
    assert.ok(right > (webgl ? 0.6 : 0.9999), `${right} of the places have a colour of the depth pane`);
    // What is nearer hides what is behind it: points with others close by on the screen and far behind.
    const near = new Float64Array(of.width * of.height).fill(Infinity);
    const far = new Float64Array(of.width * of.height);
    const inside = [...z.keys()].filter((i) => Number.isFinite(z[i])).map((i) => ({ i, ...place(of, of.eye, camera, rays, z[i], i) })).filter(({ x, y }) => x > 8 && y > 8 && x < of.width - 8 && y < of.height - 8);
    for (const { x, y, depth } of inside) {
      for (let dy = -3; dy <= 3; ++dy) {
        for (let dx = -3; dx <= 3; ++dx) {
          const at = (Math.floor(y) + dy) * of.width + Math.floor(x) + dx;
          near[at] = Math.min(near[at], depth);
          if (Math.abs(dx) <= 1 && Math.abs(dy) <= 1) far[at] = Math.max(far[at], depth);
        }
      }
    }
    const front = inside.filter(({ x, y, depth }) => depth <= 1.001 * near[Math.floor(y) * of.width + Math.floor(x)] && far[Math.floor(y) * of.width + Math.floor(x)] > 1.25 * depth);
    const seen_in_front = front.filter(({ i, x, y }) => rgb(of, Math.floor(y) * of.width + Math.floor(x)).every((one, k) => Math.abs(one - colors[4 * i + k]) <= 24)).length;
    assert.ok(front.length > 25 && seen_in_front / front.length > 0.9, `${seen_in_front} of ${front.length} points in front are seen`);
  });

  await t.test(`through the camera it is the depth pane's picture`, async () => {
    const { tab, page, rays } = kept;
    await page.locator(".stage.space").focus();
    await page.keyboard.press("t");
    await page.waitForFunction(() => window.tofray.space(1, false).eye.position.every((one) => one === 0));
    const of = await picture(tab);
    const z = frame.z_m.values;
    const { camera, frustum } = last_view(tab);
    const { pixels } = await pane(tab, 0);
    // All of the image, as large as there is room for, not stretched.
    const { left_edge, right_edge, top_edge, bottom_edge } = of.eye;
    const [xs, ys] = [0, 1].map((k) => frustum.map((one) => one[k]));
    const shares = [(Math.max(...xs) - Math.min(...xs)) / (right_edge - left_edge), (Math.max(...ys) - Math.min(...ys)) / (bottom_edge - top_edge)];
    assert.ok(Math.abs(Math.max(...shares) - 1) < 1e-9 && Math.min(...shares) <= 1 + 1e-9, shares.join());
    assert.ok(Math.abs((right_edge - left_edge) / (bottom_edge - top_edge) / (of.width / of.height) - 1) < 1e-9, "stretched");
    let [count, right] = [0, 0];
    for (let v = 2; v < height - 2; v += 7) {
      for (let u = 2; u < width - 2; u += 7) {
        const i = v * width + u;
        if (!Number.isFinite(z[i])) continue;
        const { x, y } = place(of, of.eye, camera, rays, z[i], i);
        ++count;
        const at = Math.floor(y) * of.width + Math.floor(x);
        if (rgb(of, at).every((one, k) => Math.abs(one - pixels[4 * i + k]) <= 24)) ++right;
      }
    }
    assert.ok(count > 600 && right / count > 0.9, `${right} of ${count} pixels`);
    assert.equal(await page.getByRole("button", { name: "Through the camera" }).getAttribute("aria-pressed"), "true");
    await page.keyboard.press("t");
    await page.waitForFunction(() => window.tofray.space(1, false).eye.position.some((one) => one !== 0));
  });

  await t.test(`it is turned, moved and brought nearer by mouse, wheel and keys, and that changes nothing of the state`, async () => {
    const { tab, page } = kept;
    const eye = async () => (await page.evaluate(() => window.tofray.space(1, false).eye));
    const first = await eye();
    const box = await page.locator(".stage.space").boundingBox();
    const drag = async (by, options) => {
      await page.mouse.move(box.x + 60, box.y + 60);
      await page.mouse.down(options);
      await page.mouse.move(box.x + 60 + by[0] / 2, box.y + 60 + by[1] / 2);
      await page.mouse.move(box.x + 60 + by[0], box.y + 60 + by[1]);
      await page.mouse.up(options);
      return eye();
    };
    const turned = await drag([80, 0]);
    assert.ok(dot(turned.forward, first.forward) < 0.95 && Math.abs(turned.forward[1] - first.forward[1]) < 1e-9, "a drag to the right turns about the vertical");
    const panned = await drag([0, 50], { button: "right" });
    assert.deepEqual(panned.forward, turned.forward);
    assert.ok(Math.hypot(...panned.position.map((one, k) => one - turned.position[k])) > 0.05, "the right button moves");
    await page.mouse.move(box.x + 100, box.y + 100);
    await page.mouse.wheel(0, -300);
    await page.waitForFunction((near) => window.tofray.space(1, false).eye.near < near, panned.near);
    await page.locator(".stage.space").focus();
    const before = await eye();
    await page.keyboard.press("ArrowDown");
    await page.keyboard.press("Shift+ArrowLeft");
    await page.keyboard.press("-");
    const after = await eye();
    assert.ok(after.forward[1] !== before.forward[1] && after.near > before.near);
    await page.keyboard.press("0");
    assert.deepEqual(await eye(), first);
    assert.deepEqual(await page.evaluate(() => [window.tofray.overrides, window.tofray.steps.past]), [[], 0]);
    assert.deepEqual(tab.asked.filter((one) => ["set", "state", "camera", "place", "drag"].includes(one.type)), []);
  });

  await t.test(`the pixel under the pointer is the cursor of all panes, and the cursor of all panes is marked`, async () => {
    const { tab, page, rays } = kept;
    const z = frame.z_m.values;
    const of = await picture(tab);
    const { camera } = last_view(tab);
    const box = await page.locator(".stage.space").boundingBox();
    for (const [u, v] of [[112, 120], [200, 60], [180, 130]]) {
      const i = v * width + u;
      const { x, y, depth } = place(of, of.eye, camera, rays, z[i], i);
      await page.mouse.move(box.x + x, box.y + y);
      await page.waitForFunction(() => document.querySelector(".read-out dd") !== null);
      await page.waitForTimeout(50);
      const [a, b] = (await page.locator(".read-out dd").first().textContent()).split(", ").map(Number);
      // (What is nearer within reach of the pointer comes first.)
      const found = place(of, of.eye, camera, rays, z[b * width + a], b * width + a);
      assert.ok(Math.hypot(found.x - x, found.y - y) <= 10 && found.depth < 1.03 * depth, `${a}, ${b}, pointed at ${u}, ${v}`);
      const ring = await page.locator(".space-marks .cursor").boundingBox();
      assert.ok(Math.abs(ring.x + ring.width / 2 - box.x - found.x) < 1.5 && Math.abs(ring.y + ring.height / 2 - box.y - found.y) < 1.5, "the ring is elsewhere");
    }
  });

  await t.test(`the truth, the scene, frustum, lights and axes are drawn when they are switched on, and axes have their names`, async () => {
    const { tab, page } = kept;
    const wants = () => tab.asked.filter((one) => one.type === "want").at(-1).arrays;
    assert.ok(!wants().includes("gt_z_m"));
    const differing = async (act) => {
      const before = await picture(tab);
      await act();
      await page.waitForTimeout(300);
      const after = await picture(tab);
      return [...Array(after.width * after.height).keys()].filter((i) => [0, 1, 2].some((k) => Math.abs(before.pixels[4 * i + k] - after.pixels[4 * i + k]) > 20)).map((i) => rgb(after, i));
    };
    const truth = await differing(async () => {
      await page.getByRole("button", { name: "Truth" }).click();
      await until(() => wants().includes("gt_z_m"), "true depth");
      await page.waitForTimeout(500);
    });
    assert.ok(truth.filter(([r, g, b]) => Math.abs(r - 64) < 12 && Math.abs(g - 190) < 12 && Math.abs(b - 170) < 12).length > 500, `${truth.length} places of the truth`);
    assert.ok((await differing(() => page.locator(".space-options select").first().selectOption("wire"))).length > 300, "wires");
    if (webgl) assert.ok((await differing(() => page.locator(".space-options select").first().selectOption("solid"))).length > 1000, "surfaces");
    assert.ok((await differing(() => page.getByRole("button", { name: "Frustum", exact: true }).click())).length > 200, "the frustum");
    assert.ok((await differing(() => page.getByRole("button", { name: "Lights", exact: true }).click())).length > 50, "lights");
    assert.ok((await differing(() => page.getByRole("button", { name: "Axes", exact: true }).click())).length > 30, "axes");
    const labels = await page.locator(".space-labels span").allTextContents();
    for (const name of ["x right", "y down", "z forward"]) assert.ok(labels.includes(name), labels.join());
    await page.getByRole("button", { name: "Truth" }).click();
    await page.locator(".space-options select").first().selectOption("off");
  });

  await t.test(`w moves the camera forward by its pose, one step of undo; other panes' letters do nothing there`, async () => {
    const { tab, page } = kept;
    await page.locator(".stage.space").focus();
    // At once: keys that a busy machine hands over one by one are gestures of their own.
    await page.evaluate(() => {
      for (const [key, shiftKey] of [["w", false], ["w", false], ["w", false], ["D", true]])
        for (const type of ["keydown", "keyup"]) document.activeElement.dispatchEvent(new KeyboardEvent(type, { key, shiftKey, bubbles: true, cancelable: true }));
    });
    await until(() => last_view(tab).camera.position[2] > 0.05, "the camera's new place");
    await until(() => Math.abs(last_view(tab).camera.position[0] - 0.2) < 1e-6, "the camera to the right");
    assert.ok(Math.abs(last_view(tab).camera.position[2] - 0.06) < 1e-6, String(last_view(tab).camera.position));
    await settled(tab);
    const overrides = await page.evaluate(() => window.tofray.overrides);
    assert.ok(overrides.every(({ key }) => key.startsWith("camera.")), JSON.stringify(overrides));
    await page.waitForTimeout(800);   // the gesture has ended
    assert.equal(await page.evaluate(() => window.tofray.steps.past), 1);
    for (const type of ["save", "why"]) assert.equal(tab.asked.filter((one) => one.type === type).length, 0, type);
    assert.equal(await page.evaluate(() => window.tofray.placement(0) !== undefined && document.querySelector(".compare-bar") === null), true);
    await page.keyboard.press("Control+z");
    await page.waitForFunction(() => window.tofray.overrides.length === 0);
    // Through it, a drag turns the camera.
    await page.keyboard.press("t");
    const box = await page.locator(".stage.space").boundingBox();
    await page.mouse.move(box.x + 100, box.y + 100);
    const begun = Date.now();
    await page.mouse.down();
    await page.mouse.move(box.x + 60, box.y + 100, { steps: 4 });
    await page.mouse.up();
    const took_ms = Date.now() - begun;
    await until(() => last_view(tab).camera.rotation[0][2] > 0.01, "the camera turned to the right");
    assert.ok(Math.abs(last_view(tab).camera.rotation[1][1] - 1) < 1e-9, "it stays upright");
    await page.waitForTimeout(800);
    // A drag that a busy machine hands over in parts is several gestures.
    if (took_ms < 300) assert.equal(await page.evaluate(() => window.tofray.steps.past), 1);
  });
});

test("without WebGL it says so, fetches nothing for it, and the pictures are as ever; solid surfaces and handles are not offered", async () => {
  const { tab, page, requests, troubles } = await points(false);
  assert.equal(await page.evaluate(() => document.createElement("canvas").getContext("webgl2")), null);
  await page.getByText("no WebGL: drawn by the processor").waitFor();
  assert.deepEqual(requests.filter((one) => one.includes("view3d.js")), []);
  assert.equal(await page.locator(".space-options option[value=solid]").evaluate((one) => one.disabled), true);
  assert.equal(await page.getByRole("button", { name: "Move it" }).count(), 0);
  const { z_m, flags } = rendered(words);
  same((await pane(tab, 0)).pixels, expected(tab.hello(), scale_of(tab.hello(), "z_m"), z_m.values, flags.values), "depth");
  assert.deepEqual(troubles, []);
  assert.deepEqual(await page.evaluate(() => window.violations), []);
});

test("what draws by WebGL is not in the page's first file, and is fetched when the first 3D pane is opened, with nothing reported", async () => {
  const { url } = await view(words);
  const tab = await shown(url, { webgl: true });
  const { page, requests, troubles } = tab;
  await stand_at(tab, 0);
  await page.waitForTimeout(300);
  assert.deepEqual(requests.filter((one) => one.includes("view3d")), []);
  const text = (name) => page.evaluate((file) => fetch(file).then((one) => one.text()), name);
  const [first, apart] = [await text("main.js"), await text("view3d.js")];
  for (const word of ["gl_PointSize", "gl_Position", "WEBGL_", "TransformControls"]) {
    assert.ok(!first.includes(word), `main.js has ${word}`);
    if (word !== "TransformControls") assert.ok(apart.includes(word), `view3d.js has no ${word}`);
  }
  assert.ok(first.length < 260_000, `main.js has ${first.length} bytes`);
  const before = requests.filter((one) => one.includes("view3d.js")).length;   // those of this test
  await page.locator(".stage").nth(1).focus();
  await page.keyboard.press("x");
  await page.locator('.stage.space[data-drawing="WebGL"]').waitFor();
  assert.equal(requests.filter((one) => one.includes("view3d.js")).length, before + 1);
  assert.equal(await page.locator(".pane select.cloud-color").inputValue(), "amplitude_e");   // as the pane was
  await page.keyboard.press("x");
  await page.waitForFunction(() => window.tofray.pane(1)?.array === "amplitude_e");
  assert.deepEqual(troubles, []);
  assert.deepEqual(await page.evaluate(() => window.violations), []);
});

test("a lost WebGL context: the processor goes on drawing, and WebGL comes back", async () => {
  const { tab, page } = await points(true);
  const before = await picture(tab);
  await page.evaluate(() => {
    window.lost = document.querySelector(".stage.space canvas.gpu").getContext("webgl2").getExtension("WEBGL_lose_context");
    window.lost.loseContext();
  });
  await page.locator('.stage.space[data-drawing="processor"]').waitFor();
  await page.getByText("WebGL was lost: drawn by the processor").waitFor();
  const meanwhile = await picture(tab);
  near_box(box_of(drawn_places(meanwhile)), box_of(drawn_places(before)), 4, "drawn by the processor");
  await page.evaluate(() => window.lost.restoreContext());
  await page.locator('.stage.space[data-drawing="WebGL"]').waitFor();
  const after = await picture(tab);
  assert.equal(after.drawing, "WebGL");
  near_box(box_of(drawn_places(after)), box_of(drawn_places(before)), 1, "drawn by WebGL again");
  assert.equal(await page.getByText("drawn by the processor").count(), 0);
});

test("how many objects and lights did not go into the list is said in words, where some did not", async () => {
  for (const [left_out, said] of [[0, undefined], [1, "One object or light is not drawn"], [1200, "1200 objects and lights are not drawn"]]) {
    const { page } = await points(false, { before: between({ told: { view3d: (message) => ({ ...message, left_out }) } }) });
    const word = page.locator("[data-left-out]");
    if (said === undefined) assert.equal(await word.count(), 0);
    else assert.ok((await word.textContent()).startsWith(`${said}: their list would be too long to send.`), await word.textContent());
  }
});

test("on a light page the ground is light", async () => {
  const { tab } = await points(true, { colorScheme: "light" });
  const of = await picture(tab);
  assert.ok(is_ground(of.pixels, 0, ground.light) && is_ground(of.pixels, of.width - 1, ground.light));
});

test("an object is chosen by a click or by o, and handles move it: its position is set, one step of undo", async () => {
  const { tab, page } = await points(true);
  const sphere = last_view(tab).objects.find((one) => one.name === "belly");
  const of = await picture(tab);
  const box = await page.locator(".stage.space").boundingBox();
  const at = seen(of, of.eye, sphere.position);
  await page.mouse.click(box.x + at.x, box.y + at.y);
  await page.waitForFunction((id) => document.querySelector(".object-choice").value === String(id), sphere.id);
  await page.locator(".space-labels span", { hasText: "belly" }).waitFor();
  await page.getByRole("button", { name: "Move it" }).click();
  // The handle of x: an eighth of the picture's height long, and farther.
  const far = Math.hypot(...sphere.position.map((one, k) => one - of.eye.position[k]));
  const reach = (far * (of.eye.bottom_edge - of.eye.top_edge)) / 8;
  const tip = seen(of, of.eye, [sphere.position[0] + reach, sphere.position[1], sphere.position[2]]);
  await page.waitForTimeout(300);
  const [x, y] = [box.x + at.x + 0.8 * (tip.x - at.x), box.y + at.y + 0.8 * (tip.y - at.y)];
  await page.mouse.move(x, y);
  await page.waitForTimeout(100);
  await page.mouse.down();
  await page.mouse.move(x + 0.5 * (tip.x - at.x), y + 0.5 * (tip.y - at.y), { steps: 5 });
  await page.mouse.up();
  await until(() => tab.asked.some((one) => one.type === "place"), "a place");
  await settled(tab);
  await until(() => last_view(tab).objects.find((one) => one.id === sphere.id).position[0] > sphere.position[0] + 0.02, "the object's new place");
  const moved = last_view(tab).objects.find((one) => one.id === sphere.id).position;
  assert.ok(Math.abs(moved[1] - sphere.position[1]) < 1e-5 && Math.abs(moved[2] - sphere.position[2]) < 1e-5, `along x alone: ${moved}`);
  await page.waitForTimeout(300);
  const { overrides, past } = await page.evaluate(() => ({ overrides: window.tofray.overrides, past: window.tofray.steps.past }));
  assert.deepEqual([overrides.map((one) => one.key), past], [[`${sphere.key}.sphere.position`], 1]);
  // By keys.
  await page.locator(".stage.space").focus();
  await page.keyboard.press("Escape");
  await page.waitForFunction(() => document.querySelector(".object-choice").value === "");
  await page.keyboard.press("o");
  await page.keyboard.press("o");
  await page.waitForFunction(() => document.querySelector(".object-choice").value === "1");
  const past_before = await page.evaluate(() => window.tofray.steps.past);
  for (let i = 0; i < 3; ++i) await page.keyboard.press("Control+ArrowUp");
  await until(() => Math.abs(last_view(tab).objects[1].position[1] - 0.19) < 1e-6, "the floor, 6 cm higher");
  await page.waitForTimeout(800);
  assert.equal(await page.evaluate(() => window.tofray.steps.past), past_before + 1);
  await set(tab, "camera.lens.f_number", "2.8");   // another step
  assert.equal(await page.evaluate(() => window.tofray.steps.past), past_before + 2);
});

test("of two states it shows the one that controls change, and B while b is held down; closed and opened again it is there again", async () => {
  const { tab, page } = await points(false);
  const other_button = page.getByRole("button", { name: "A | B", exact: true });
  for (const time of ["once", "again"]) {
    await other_button.click();
    await page.locator(".space .badge.b").waitFor();
    await page.waitForFunction(() => window.tofray.last_b !== undefined);
    await until(() => last_view(tab).side === "b", `B, ${time}`);
    await page.waitForTimeout(300);
    assert.ok(drawn_places(await picture(tab)).length > 5000, `B is drawn, ${time}`);
    await page.getByRole("group", { name: "Controls of" }).getByRole("button", { name: "A" }).click();
    await page.locator(".space .badge.a").waitFor();
    await page.locator(".stage").first().focus();
    await page.keyboard.down("b");
    await page.locator(".space .badge.b").waitFor();
    await page.keyboard.up("b");
    await page.locator(".space .badge.a").waitFor();
    await other_button.click();
    await page.locator(".space .badge").waitFor({ state: "detached" });
    await page.waitForFunction(() => window.tofray.last_b === undefined);
  }
  assert.ok(drawn_places(await picture(tab)).length > 5000, "A is drawn");
});

test("fingers: one turns, two bring nearer and move", async () => {
  const { page } = await points(false, { hasTouch: true });
  const eye = () => page.evaluate(() => window.tofray.space(1, false).eye);
  const box = await page.locator(".stage.space").boundingBox();
  const devices = await page.context().newCDPSession(page);
  const touch = (kind, ...places) => devices.send("Input.dispatchTouchEvent", { type: kind, touchPoints: places.map(([x, y], id) => ({ x: box.x + x, y: box.y + y, id })) });
  const first = await eye();
  await touch("touchStart", [100, 100]);
  for (const x of [110, 130, 160]) await touch("touchMove", [x, 100]);
  await touch("touchEnd");
  const turned = await eye();
  assert.ok(dot(turned.forward, first.forward) < 0.98);
  await touch("touchStart", [100, 100], [140, 100]);
  await touch("touchMove", [80, 100], [160, 100]);
  await touch("touchMove", [60, 100], [180, 100]);
  await touch("touchEnd");
  const near = await eye();
  assert.ok(near.near < 0.5 * turned.near, `${near.near}, before ${turned.near}`);
  assert.deepEqual(near.forward, turned.forward);
});

test("a file that cannot be fetched is told, and the processor draws", async () => {
  const { url } = await view(words);
  const tab = await shown(url, { webgl: true, before: (page) => page.route(/view3d\.js$/, (route) => route.abort()) });
  await stand_at(tab, 0);
  await tab.page.locator(".pane select.shows").nth(1).selectOption("3D points");
  await tab.page.getByText("view3d.js could not be fetched: drawn by the processor").waitFor();
  await until(() => tab.arrays.length > 0, "rays");
  await tab.page.waitForTimeout(300);
  assert.ok(drawn_places(await picture(tab)).length > 3000);
});

test("handles turn a box about its centre: its rotation is set, and stays one; its position stays", async () => {
  const { tab, page } = await points(true);
  const chosen = last_view(tab).objects.find((one) => one.kind === "box" && one.movable);
  await page.locator(".object-choice").selectOption(String(chosen.id));
  await page.getByRole("button", { name: "Turn it" }).click();
  await page.waitForTimeout(300);
  const of = await picture(tab);
  const box = await page.locator(".stage.space").boundingBox();
  const at = seen(of, of.eye, chosen.position);
  await page.mouse.move(box.x + at.x + 3, box.y + at.y + 3);
  await page.waitForTimeout(100);
  await page.mouse.down();
  await page.mouse.move(box.x + at.x + 33, box.y + at.y + 3, { steps: 4 });
  await page.mouse.up();
  await until(() => tab.asked.some((one) => one.type === "place"), "a place");
  const places = tab.asked.filter((one) => one.type === "place");
  assert.ok(places.every((one) => one.position === null && one.rotation !== null && one.object === chosen.id), JSON.stringify(places.at(-1)));
  await settled(tab);
  const now = () => last_view(tab).objects.find((one) => one.id === chosen.id);
  await until(() => Math.abs(now().rotation[0][2]) > 0.02, "the box turned");
  await page.waitForTimeout(300);
  now().position.forEach((one, k) => assert.ok(Math.abs(one - chosen.position[k]) < 1e-6, `it is at ${now().position}`));
  const rows = now().rotation;
  rows.forEach((a, i) => rows.forEach((b, j) => assert.ok(Math.abs(dot(a, b) - (i === j ? 1 : 0)) < 1e-6, "a rotation")));
  // Its front went to the right, as the pointer did.
  const front = of.eye.forward.map((one) => -0.1 * one);
  const own = [0, 1, 2].map((k) => dot(chosen.rotation.map((row) => row[k]), front));
  const turned = rows.map((row) => dot(row, own));
  const [x0, x1] = [front, turned].map((offset) => seen(of, of.eye, chosen.position.map((one, k) => one + offset[k])).x);
  assert.ok(x1 > x0 + 2, `the front went from ${x0} to ${x1}`);
  const { overrides, past } = await page.evaluate(() => ({ overrides: window.tofray.overrides, past: window.tofray.steps.past }));
  assert.ok(overrides.length >= 1 && overrides.every((one) => one.key.startsWith(`${chosen.key}.`)), JSON.stringify(overrides));
  assert.equal(past, 1);
});
