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
