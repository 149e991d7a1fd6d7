// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
import { batch } from "@preact/signals";
import { render } from "preact";
import { App } from "./app";
import { fault_arrived, opened_anew, pixel_arrived, start_asking } from "./ask";
import { connect } from "./connection";
import { start_keys } from "./keys";
import { frame_arrived, start_loop } from "./loop";
import { read_frame, type Hello, type ServerMessage, type State } from "./protocol";
import { choose_arrays, fault, fitted, frame, hello, pixel, state, stats } from "./store";
import { offer_to_tests } from "./test_hooks";

function greeted(by: Hello): void {
  batch(() => {
    hello.value = by;
    const { generation, playing, frame: at, seed, command } = by;
    state.value = { type: "state", generation, playing, frame: at, seed, command };
    fitted.value = new Map();
    frame.value = undefined;
    pixel.value = undefined;
    choose_arrays(by);
  });
  document.title = `${by.scene} – tofray view`;
  if (by.test_hooks === true) offer_to_tests();
  opened_anew();
}

/** A state may bring other numbers of the camera: the greeting's follow. */
function changed(to: State): void {
  const now = hello.peek();
  batch(() => {
    state.value = to;
    if (now !== undefined && to.width !== undefined && to.height !== undefined && (to.width !== now.width || to.height !== now.height)) {
      hello.value = { ...now, width: to.width, height: to.height, phases: to.phases ?? now.phases };
    }
  });
}

function text_arrived(message: ServerMessage): void {
  switch (message.type) {
    case "hello": return greeted(message);
    case "state": return changed(message);
    case "scale": return void (fitted.value = new Map(fitted.peek()).set(message.array, message.scale));
    case "pixel": return pixel_arrived(message);
    case "stats": return void (stats.value = message);
    case "fault":
      fault_arrived(message);
      fault.value = message;
  }
}

const root = document.getElementById("page");
if (root !== null) render(<App />, root);
start_loop();
start_asking();
start_keys();
connect({ opened: () => undefined, text: text_arrived, binary: (message) => frame_arrived(read_frame(message)) });
