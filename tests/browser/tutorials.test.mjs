// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Tutorials that are done in the viewer: each step can be done as it says, and what it says is there to be read then.

import assert from "node:assert/strict";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { follow, steps_of } from "./tutorial.mjs";
import { test } from "./viewer.mjs";

const corner = join(dirname(fileURLToPath(import.meta.url)), "../../docs/bent-corner.md");

test("why does this corner bend?", async () => {
  const steps = steps_of(corner);
  assert.ok(steps.flatMap((one) => one.names ?? []).length > 8 && steps.flatMap((one) => one.figures ?? []).length > 3, "what is there to be checked");
  const { troubles } = await follow(corner);
  assert.deepEqual(troubles, []);
});
