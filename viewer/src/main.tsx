// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
import { batch } from "@preact/signals";
import { render } from "preact";
import { App } from "./app";
import { fault_arrived, opened_anew, pixel_arrived, start_asking } from "./ask";
import { connect, server_count } from "./connection";
import { change_refused, controls_arrived, done_arrived, forget_unanswered, saved_arrived, start_editing } from "./edit";
import { history_goes_on, history_of_greeting, start_history } from "./history";
import { start_keeping } from "./keep";
import { start_keys } from "./keys";
import { forget_b, frame_arrived, start_loop } from "./loop";
import { forget_moves, start_hands } from "./hands";
import { answer_arrived, arrays_arrived, forget_questions, question_refused } from "./questions";
import { forget_space, start_space } from "./space";
import { forget_tools, start_tools } from "./tools";
import type { Hello, ServerMessage, State } from "./protocol";
import { choose_arrays, controls, difference_scales, fault, fitted, frame, hello, key_faults, link, other, pixel, pixel_b, raw_scales, state, stats } from "./store";
import { offer_to_tests } from "./test_hooks";
import { frame_came, start_watching, statistics_anew } from "./watch";
import { read_frame } from "./wire";
import { forget_why, start_why, why_arrived, why_refused } from "./why";

let server = 0;

function greeted(by: Hello): void {
  const before = hello.peek();
  batch(() => {
    hello.value = by;
    const { generation, playing, frame: at, seed, command, scene } = by;
    state.value = { type: "state", generation, playing, frame: at, seed, command, scene, overrides: by.overrides, other: by.other };
    other.value = by.other ?? undefined;
    fitted.value = difference_scales.value = new Map();
    raw_scales.value = new Map();
    key_faults.value = new Map();
    frame.value = undefined;
    pixel.value = pixel_b.value = undefined;
    controls.a.value = controls.b.value = undefined;
    forget_b();
    forget_unanswered();
    forget_why();
    forget_moves();
    forget_tools();
    for (const side of ["a", "b"] as const) forget_space(side);
    forget_questions();
    statistics_anew();
    choose_arrays(by);
  });
  document.title = `${by.scene} – tofray view`;
  if (by.test_hooks === true) offer_to_tests();
  opened_anew();
  history_of_greeting(by, before, server !== 0 && server !== server_count);
  server = server_count;
}

/** A state may bring other numbers of the camera: the greeting's follow. */
function changed(to: State): void {
  const now = hello.peek();
  batch(() => {
    state.value = to;
    other.value = to.other ?? undefined;
    if (now !== undefined) {
      const { width = now.width, height = now.height, phases = now.phases, camera = now.camera, mode = now.mode, frame_rate_hz = now.frame_rate_hz } = to;
      const same = width === now.width && height === now.height && phases === now.phases && camera === now.camera && mode === now.mode && frame_rate_hz === now.frame_rate_hz;
      if (!same) hello.value = { ...now, width, height, phases, camera, mode, frame_rate_hz };
    }
    if (other.value === undefined) forget_b();
  });
  history_goes_on();
}

function text_arrived(message: ServerMessage): void {
  switch (message.type) {
    case "hello": return greeted(message);
    case "state": return changed(message);
    case "scale": return void (fitted.value = new Map(fitted.peek()).set(message.array, message.scale));
    case "pixel": return pixel_arrived(message);
    case "why": return why_arrived(message);
    case "stats": return void (stats.value = message);
    case "controls": return controls_arrived(message);
    case "done": return done_arrived(message);
    case "saved": return saved_arrived(message);
    case "view3d": return answer_arrived(message, message.static === true ? message.arrays : []);
    case "temporal": return answer_arrived(message, message.arrays, message.arrays === undefined);
    case "drag":
    case "place":
    case "camera":
    case "measure":
    case "region":
    case "restore": return answer_arrived(message);
    case "screenshot": return answer_arrived(message, message.arrays);
    case "record": return answer_arrived(message, [], message.files === undefined);
    case "export": return answer_arrived(message, [], message.file === undefined);
    case "fault":
      fault_arrived(message);
      if (question_refused(message)) return;
      if (!why_refused(message) && !change_refused(message)) fault.value = message;
  }
}

function frame_received(message: ArrayBuffer): void {
  const fresh = read_frame(message);
  if (fresh.answers) return arrays_arrived(fresh);
  frame_came(fresh);
  frame_arrived(fresh);
}

const root = document.getElementById("page");
if (root !== null) render(<App />, root);
start_loop();
start_asking();
start_editing();
start_history();
start_watching();
start_why();
start_hands();
start_space();
start_tools();
start_keeping();
start_keys();
try {
  connect({ opened: () => undefined, text: text_arrived, binary: frame_received });
} catch (error) {
  link.value = "empty";
  fault.value = { type: "fault", id: null, text: "There is nothing to be seen in this file.", more: error instanceof Error ? error.message : String(error) };
}
