// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "commands.h"

namespace tofray::app {

namespace {

const std::vector<const char*> simulation = {"--output", "--set", "--mode", "--seed", "--noise", "--emit", "--root", "--threads", "--backend"};

std::vector<const char*> simulation_and(std::vector<const char*> more) {
  std::vector<const char*> all = simulation;
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

std::vector<Command> make() {
  return {
      {"demo", "[options]", "simulate the built-in scene: a picture in the terminal, all files in ./tofray-demo",
       "tofray demo                          # a camera looks at a snowman\n"
       "tofray demo -o out --noise off       # without noise, files in ./out\n"
       "tofray demo --set objects.2.sphere.radius=\"30 cm\"\n",
       "", simulation_and({"--json", "--quiet"}), 0, 0, run_demo, ""},
      {"render", "SCENE [options]", "simulate what a camera sees: raw frames, depth, ground truth, pictures, point cloud",
       "tofray render scene.yaml -o out                          # one frame, all files\n"
       "tofray render scene.yaml -o out --frames 100 --seed 7    # frame_0000.npz to frame_0099.npz\n"
       "tofray render room --set camera.lens.f_number=1.2        # a built-in scene, another lens\n"
       "tofray render --from out/manifest.json -o again          # the same bytes again\n",
       "SCENE is a YAML or JSON file, or a name out of `tofray list scenes`. Without -o the folder is called like the scene.\n"
       "Same version, scene, options and seed: the same bytes, for any number of threads.\n",
       simulation_and({"--frames", "--first-frame", "--from", "--json", "--quiet"}), 1, 1, run_render, "scenes"},
      {"process", "RAW.npz [options]", "turn raw frames, simulated or measured, into depth",
       "tofray process out/frame.npz -o again --set camera.decoding.filter.kind=median\n"
       "tofray process recording.npz --camera mycam.yaml -o out  # your own camera's raw frames\n",
       "RAW.npz holds raw [phase, height, width] (codes), or tap_a and tap_b (electrons), and by phase modulation_frequency_hz,\n"
       "reference_phase_rad, integration_time_s and lit. Without --camera it is the camera that the file says it was made with.\n",
       {"--camera", "--output", "--set", "--mode", "--emit", "--threads", "--backend", "--json", "--quiet"}, 1, 1, run_process, "files"},
      {"inspect", "FILE [options]", "what is in a file: arrays, units, phase table, statistics; one pixel's whole chain",
       "tofray inspect out/frame.npz                     # arrays, raw frames, how many pixels are invalid and why\n"
       "tofray inspect out/frame.npz --pixel 112,86      # surface, power, electrons, every raw frame, phase, depth\n"
       "tofray inspect scene.yaml --pixel 112,86         # the same, simulated now\n",
       "FILE is a .npz file, a scene file or the name of a built-in scene.\n",
       {"--pixel", "--set", "--mode", "--seed", "--noise", "--root", "--threads", "--backend", "--json"}, 1, 1, run_inspect, "scenes"},
      {"check", "FILE [options]", "read a scene or a camera profile and report every fault with its place",
       "tofray check scene.yaml\n"
       "tofray check mycam.yaml                          # also names the numbers that do not say where they come from\n"
       "tofray check scene.yaml --set ambient.level=\"5 %\"\n",
       "", {"--set", "--mode", "--root", "--json", "--quiet"}, 1, 1, run_check, "scenes"},
      {"list", "cameras|scenes|materials", "what is built in, and the materials of a scene",
       "tofray list scenes\n"
       "tofray list cameras                              # with their modes\n"
       "tofray list materials demo                       # those of a scene; without one, of all built-in scenes\n",
       "", {"--json"}, 1, 2, run_list, "cameras scenes materials"},
      {"schema", "scene|camera", "JSON Schema of a file kind, for editors that complete and check",
       "tofray schema scene > scene.schema.json\n"
       "tofray schema camera > camera.schema.json\n",
       "", {}, 1, 1, run_schema, "scene camera"},
      {"doctor", "[options]", "check this machine: processor, threads, memory, a self-test; what is missing",
       "tofray doctor\n"
       "tofray doctor --json                             # to attach to a report\n",
       "Exit code 1 where the self-test fails.\n", {"--threads", "--backend", "--json"}, 0, 0, run_doctor, ""},
      {"bench", "[SCENE] [options]", "measure speed: frames per second, time per frame, memory",
       "tofray bench                                     # the scene bench-primitives\n"
       "tofray bench room --frames 200 --noise fast --threads 1\n"
       "tofray bench --compare                           # variants in turn, ratios of their medians\n",
       "", {"--frames", "--warmup", "--compare", "--set", "--mode", "--seed", "--noise", "--root", "--threads", "--backend", "--json"}, 0, 1,
       run_bench, "scenes"},
      {"completion", "bash|zsh|fish", "a script that lets the shell complete tofray's commands and options",
       "source <(tofray completion bash)                 # now; put it into ~/.bashrc to keep it\n"
       "tofray completion zsh > ~/.zfunc/_tofray\n"
       "tofray completion fish > ~/.config/fish/completions/tofray.fish\n",
       "", {}, 1, 1, run_completion, "bash zsh fish"},
  };
}

}  // namespace

const std::vector<Command>& all_commands() {
  static const std::vector<Command> all = make();
  return all;
}

const Command* find_command(std::string_view name) {
  for (const Command& command : all_commands()) {
    if (name == command.name) return &command;
  }
  return nullptr;
}

}  // namespace tofray::app
