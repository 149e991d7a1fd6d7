// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>

#include "files/json.h"
#include "support/tool.h"

namespace tofray::test {
namespace {

const std::vector<std::string> commands = {"demo", "render", "process",     "inspect", "preview", "view",      "stream",
                                           "diff", "check",  "budget",      "sweep",   "dataset", "quality",   "compare",
                                           "list", "schema", "calibration", "doctor",  "bench",   "completion"};

TEST(help, comes_on_stdout_with_examples_first) {
  for (const Arguments& asked : {Arguments{"--help"}, Arguments{"help"}, Arguments{"-h"}}) {
    const Result result = run(asked);
    EXPECT_EQ(result.code, 0);
    EXPECT_LT(result.out.find("Examples:"), result.out.find("Commands:"));
    for (const std::string& command : commands) EXPECT_TRUE(has(result.out, "\n  " + command + " ")) << command;
  }
  for (const std::string& command : commands) {
    const Result result = run({command, "--help"});
    EXPECT_EQ(result.code, 0);
    EXPECT_TRUE(result.out.starts_with("Examples:\n  ")) << result.out;
    EXPECT_LT(result.out.find("tofray " + command), result.out.find("Usage:")) << result.out;
    EXPECT_EQ(result.err, "");
    EXPECT_EQ(run({"help", command}).out, result.out);
  }
}

TEST(usage, nothing_said_is_bad_usage) {
  const Result result = run({});
  EXPECT_EQ(result.code, 2);
  EXPECT_EQ(result.out, "");
  EXPECT_TRUE(has(result.err, "Commands:"));
}

TEST(usage, version_and_limits) {
  for (const char* word : {"--version", "version", "-V"}) EXPECT_EQ(run({word}).out, "tofray 0.2.0\n") << word;
  EXPECT_TRUE(has(run({"--limits"}).out, "\nsensor_pixels"));
  EXPECT_EQ(files::parse_json(run({"--version", "--json"}).out, "stdout").find("tofray")->string()->substr(0, 4), "0.2.");
  EXPECT_NE(files::parse_json(run({"--limits", "--json"}).out, "stdout").find("raw_samples"), nullptr);
}

struct Mistake {
  Arguments arguments;
  int code;
  std::string says;
};

class bad_usage : public testing::TestWithParam<Mistake> {};

TEST_P(bad_usage, is_refused_with_a_hint_and_nothing_on_stdout) {
  const Folder folder;
  const Result result = run(GetParam().arguments, in_folder(folder.path()));
  EXPECT_EQ(result.code, GetParam().code) << result.err;
  EXPECT_TRUE(has(result.err, GetParam().says)) << result.err;
  EXPECT_EQ(result.out, "");
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

INSTANTIATE_TEST_SUITE_P(
    all, bad_usage,
    testing::Values(
        Mistake{{"fit", "o3d303"}, 2, "expected python3 -m tofray fit PROFILE FILE"}, Mistake{{"rendr"}, 2, "did you mean \"render\"?"},
        Mistake{{"chek", "demo"}, 2, "did you mean \"check\"?"}, Mistake{{"--verison"}, 2, "did you mean \"--version\"?"},
        Mistake{{"--seed", "3", "demo"}, 2, "stands before the command"}, Mistake{{"demo", "--sede", "3"}, 2, "did you mean \"--seed\"?"},
        Mistake{{"demo", "--thread=3"}, 2, "did you mean \"--threads\"?"},
        Mistake{{"list", "scenes", "--seed", "3"}, 2, "`tofray list` has no option --seed"}, Mistake{{"demo", "--seed"}, 2, "--seed"},
        Mistake{{"demo", "--seed", "-1"}, 2, "expected a whole number"},
        Mistake{{"demo", "--seed", "18446744073709551616"}, 2, "18446744073709551615"},
        Mistake{{"demo", "--seed", "1e3"}, 2, "whole number"}, Mistake{{"demo", "--threads", "1025"}, 2, "0 to 1024"},
        Mistake{{"demo", "--noise", "of"}, 2, "off (expected values)"}, Mistake{{"demo", "--emit", "npz,pgn"}, 2, "npz, png, ply"},
        Mistake{{"demo", "--set", "lens"}, 2, "KEY=VALUE"}, Mistake{{"demo", "--set", "=3"}, 2, "KEY=VALUE"},
        Mistake{{"demo", "--set", "camera.lens.fnumber=1.2"}, 2, "did you mean \"f_number\"?"},
        Mistake{{"demo", "--backend", "cuda"}, 5, "no GPU can be used"}, Mistake{{"demo", "--backend", "cpus"}, 2, "auto, cpu or cuda"},
        Mistake{{"demo", "card"}, 2, "unexpected \"card\""}, Mistake{{"render"}, 2, "needs SCENE"},
        Mistake{{"render", "card", "demo"}, 2, "unexpected \"demo\""}, Mistake{{"render", "crad"}, 3, "did you mean \"card\"?"},
        Mistake{{"render", "./none.yaml"}, 3, "none.yaml"}, Mistake{{"render", "card", "--frames", "0"}, 2, "1 to"},
        Mistake{{"render", "card", "--mode", "MODE_9_5FPS_200"}, 2, "MODE_9_5FPS_2000"},
        Mistake{{"render", "card", "--from", "x.json"}, 3, "x.json"}, Mistake{{"process", "none.npz"}, 3, "none.npz"},
        Mistake{{"inspect", "none.npz"}, 3, "none.npz"}, Mistake{{"preview", "none.npz"}, 3, "none.npz"},
        Mistake{{"preview", "card", "-o", "card.jpg"}, 2, ".png, .svg or .pdf"},
        Mistake{{"preview", "card", "-o", "card"}, 2, ".png, .svg or .pdf"},
        Mistake{{"preview", "card", "-o", ".svg.gz"}, 2, ".png, .svg or .pdf"},
        Mistake{{"preview", "card", "--scale", "2"}, 2, "--scale is of a picture in a file"},
        Mistake{{"preview", "card", "--raw"}, 2, "expected -o with it"}, Mistake{{"preview", "card", "-o="}, 2, "expected -o FILE"},
        Mistake{{"render", "card", "-o="}, 2, "expected -o DIR"}, Mistake{{"inspect", "card", "--pixel", "3"}, 2, "column,row"},
        Mistake{{"inspect", "card", "--pixel", "224,0"}, 2, "column of 0 to 223"},
        Mistake{{"list", "scene"}, 2, "did you mean \"scenes\"?"}, Mistake{{"list", "scenes", "card"}, 2, "unexpected"},
        Mistake{{"schema", "scenes"}, 2, "scene"}, Mistake{{"completion", "bsh"}, 2, "did you mean \"bash\"?"},
        Mistake{{"demo", "--set", "camera.sensor.width=99999"}, 2, "16384"},
        Mistake{{"demo", "--set", "camera.sensor.width=16384", "--set", "camera.sensor.height=16384"}, 4, "--limits"},
        Mistake{{"bench", "--block-size", "33"}, 2, "multiples of 32"}, Mistake{{"bench", "--block-size", "0"}, 2, "multiples of 32"},
        Mistake{{"bench", "--block-size", "32:1056:32"}, 2, "up to 1024"},
        Mistake{{"bench", "--block-size", "64:32:32"}, 2, "first:last:step"},
        Mistake{{"bench", "--block-size", "32:1024:16"}, 2, "first:last:step"},
        Mistake{{"bench", "--block-size", "32:1024"}, 2, "32:1024:32"}, Mistake{{"bench", "--block-size", "32:64:32:32"}, 2, "32:1024:32"},
        Mistake{{"bench", "--block-size", "32,,64"}, 2, "multiples of 32"}, Mistake{{"bench", "--block-size", "-32"}, 2, "multiples of 32"},
        Mistake{{"bench", "--block-size", "32 "}, 2, "multiples of 32"}, Mistake{{"bench", "--block-size", ""}, 2, "multiples of 32"},
        Mistake{{"bench", "--stage", "power,al"}, 2, "trace, power, raw, all"}, Mistake{{"bench", "--stage", ""}, 2, "trace, power"},
        Mistake{{"bench", "--stage", "power,"}, 2, "trace, power"},
        Mistake{{"bench", "--backend", "cpu", "--block-size", "64"}, 2, "--block-size is a GPU's"},
        Mistake{{"bench", "--compare", "--stage", "all"}, 2, "--compare"},
        Mistake{{"bench", "--compare", "--backend", "cuda"}, 2, "--compare"}, Mistake{{"bench", "--batch", "0"}, 2, "1 to 1000000"},
        Mistake{{"bench", "--batch", "3", "--stage", "all"}, 2, "--batch"}, Mistake{{"bench", "--batch", "3", "--compare"}, 2, "--batch"},
        Mistake{{"demo", "--set", "camera.lens.f_number=1.2", "foo"}, 2, "in quotes: --set \"camera.lens.f_number=1.2 foo\""},
        Mistake{{"demo", "--set=objects.2.sphere.radius=30", "cm"}, 2, "in quotes: --set \"objects.2.sphere.radius=30 cm\""},
        Mistake{{"render", "--set", "ambient.level=5", "%"}, 2, "in quotes: --set \"ambient.level=5 %\""},
        Mistake{{"render", "--set", "ambient.level=5", "%", "card"}, 2, "in quotes: --set \"ambient.level=5 %\""},
        Mistake{{"demo", "--theme", "white"}, 2, "dark or light"}, Mistake{{"render", "card", "-o="}, 2, "-o= has no value"},
        Mistake{{"render", "card", "-q=1"}, 2, "-q takes no value"},
        Mistake{{"render", "card", "--block-size", "64"}, 2, "`tofray render` has no option --block-size"}));

TEST(usage, options_may_come_in_every_form) {
  const Folder folder;
  const Prepare here = in_folder(folder.path());
  ASSERT_EQ(run(with_small_sensor({"render", "card", "-o", "a", "--seed", "5"}), here).code, 0);
  ASSERT_EQ(run(with_small_sensor({"render", "-ob", "--seed=5", "card"}), here).code, 0);
  ASSERT_EQ(run(with_small_sensor({"render", "--output=c", "--seed=4", "--seed=5", "card"}), here).code, 0);
  EXPECT_EQ(files_of(folder / "a"), files_of(folder / "b"));
  EXPECT_EQ(files_of(folder / "a"), files_of(folder / "c"));
  ASSERT_EQ(run(with_small_sensor({"render", "-o=d", "--seed=5", "card"}), here).code, 0);
  EXPECT_EQ(files_of(folder / "a"), files_of(folder / "d"));
  EXPECT_FALSE(fs::exists(folder / "=d"));
}

TEST(list, of_materials_has_what_the_brdf_of_each_reads) {
  const std::string text = run({"list", "materials", "demo"}).out;
  EXPECT_TRUE(has(text, "coal           lambert, reflectivity 0.08\n")) << text;
  EXPECT_TRUE(has(text, "carrot         phong, diffuse 0.5, specular 0.1, exponent 10\n")) << text;
  const files::Json json = files::parse_json(run({"list", "materials", "demo", "--json"}).out, "list");
  const auto named = [](const files::Json& all, const char* name) {
    const auto& items = *all.find("materials")->items();
    return *std::find_if(items.begin(), items.end(), [&](const files::Json& one) { return *one.find("name")->string() == name; });
  };
  EXPECT_NE(named(json, "carrot").find("exponent"), nullptr);
  EXPECT_EQ(named(json, "coal").find("exponent"), nullptr);
  const files::Json library = files::parse_json(run({"list", "materials", "--json"}).out, "list");
  double diffuse = 0;
  EXPECT_TRUE(named(library, "skin").find("diffuse")->number(diffuse));
  EXPECT_EQ(diffuse, 0.603);
  EXPECT_TRUE(has(*named(library, "skin").find("source")->string(), "human skin reflectance"));
  EXPECT_TRUE(has(run({"list", "materials"}).out, "| `skin` | lambert, reflectivity 0.603 |"));
}

TEST(json, is_one_object_on_stdout) {
  const Folder folder;
  const Prepare here = in_folder(folder.path());
  const std::vector<Arguments> all = {with_small_sensor({"demo"}),
                                      with_small_sensor({"render", "card", "-o", "card"}),
                                      {"process", "card/frame.npz"},
                                      {"inspect", "card/frame.npz"},
                                      {"inspect", "card/frame.npz", "--pixel", "3,4"},
                                      {"preview", "card/frame.npz", "-o", "card.svg"},
                                      {"check", "card"},
                                      {"check", "pico-flexx"},
                                      {"list", "scenes"},
                                      {"list", "cameras"},
                                      {"list", "materials"},
                                      {"list", "controls", "imx556"},
                                      {"doctor"},
                                      with_small_sensor({"bench", "--frames", "2"})};
  for (Arguments arguments : all) {
    arguments.emplace_back("--json");
    const Result result = run(arguments, here);
    EXPECT_EQ(result.code, 0) << arguments[0] << result.err;
    EXPECT_TRUE(files::parse_json(result.out, arguments[0]).is_object());
    EXPECT_FALSE(has(result.err, "error"));
  }
  for (const char* kind : {"scene", "camera"}) EXPECT_NE(files::parse_json(run({"schema", kind}).out, kind).find("$schema"), nullptr);
}

TEST(list, of_controls_has_what_is_in_force_of_a_scene_or_a_camera) {
  const files::Json json = files::parse_json(run({"list", "controls", "room", "--json"}).out, "list");
  std::map<std::string, std::string> texts;
  for (const files::Json& one : *json.find("controls")->items())
    if (const files::Json* text = one.find("text")) texts[*one.find("key")->string()] = *text->string();
  EXPECT_EQ(texts["camera.profile"], "pico-flexx");
  EXPECT_EQ(texts["camera.pixel.full_well"], "100000 e");
  EXPECT_TRUE(has(run({"list", "controls", "imx556"}).out, "camera.profile                                       imx556"));
  EXPECT_TRUE(has(run({"list", "controls"}).out, "objects.2.sphere.radius"));  // of the demo
  EXPECT_EQ(run({"list", "controls", "no-such-scene"}).code, 3);
}

TEST(json, of_a_fault_is_one_object_that_names_its_place) {
  const Folder folder;
  const Prepare here = in_folder(folder.path());
  std::ofstream(folder / "bad.yaml") << "objects:\n  - sphere: {center: [0, 0, 1], radius: 25 kg, reflectivity: 0.5}\nlihgts: []\n";
  const Result result = run({"check", "bad.yaml", "--json"}, here);
  EXPECT_EQ(result.code, 2);
  EXPECT_EQ(result.err, run({"check", "bad.yaml"}, here).err);  // people read the same
  const files::Json json = files::parse_json(result.out, "stdout");
  EXPECT_FALSE(*json.find("good")->boolean());
  const files::Json::Array& faults = *json.find("faults")->items();
  ASSERT_EQ(faults.size(), 2u);
  double line = 0, column = 0;
  EXPECT_TRUE(faults[0].find("line")->number(line) && faults[0].find("column")->number(column));
  EXPECT_EQ(line, 2);
  EXPECT_EQ(column, 41);
  EXPECT_EQ(*faults[0].find("file")->string(), "bad.yaml");
  EXPECT_TRUE(has(*faults[0].find("text")->string(), "radius"));
  EXPECT_TRUE(has(*faults[0].find("more")->string(), "25 kg"));
  EXPECT_TRUE(has(*faults[1].find("text")->string(), "lihgts"));
}

TEST(json, of_every_command_that_fails_is_one_object) {
  const Folder folder;
  const std::vector<Arguments> all = {
      {"demo", "--seed", "x"}, {"render", "none.yaml"}, {"process", "none.npz"}, {"inspect", "none.npz"},   {"check", "none.yaml"},
      {"list", "things"},      {"bench", "none.yaml"},  {"doctor", "--bogus"},   {"render", "--from", "x"}, {"demo", "--set", "a.b=1"}};
  for (Arguments arguments : all) {
    arguments.emplace_back("--json");
    const Result result = run(arguments, in_folder(folder.path()));
    EXPECT_GE(result.code, 2) << arguments[0];
    const files::Json json = files::parse_json(result.out, arguments[0]);
    double code = 0;
    EXPECT_TRUE(json.find("exit_code")->number(code));
    EXPECT_EQ(code, result.code);
    EXPECT_EQ(json.find("faults")->items()->size(), 1u) << result.out;
    EXPECT_TRUE(has(result.err, *(*json.find("faults")->items())[0].find("text")->string())) << result.err;
  }
}

TEST(completion, of_bash_knows_commands_options_and_scenes) {
  const Folder folder;
  ASSERT_EQ(run({"completion", "bash"}).code, 0);
  std::ofstream(folder / "tofray.bash") << run({"completion", "bash"}).out;
  const auto replies = [&](const std::string& words, int at) {
    const std::string script = "PATH=" + fs::path(TOFRAY_TOOL).parent_path().native() + ":$PATH; source " +
                               (folder / "tofray.bash").native() + "; COMP_WORDS=(" + words + "); COMP_CWORD=" + std::to_string(at) +
                               "; _tofray; echo \"${COMPREPLY[*]}\" > " + (folder / "reply").native();
    EXPECT_EQ(std::system(("bash -c '" + script + "'").c_str()), 0);
    return content(folder / "reply");
  };
  EXPECT_EQ(replies("tofray ren", 1), "render\n");
  EXPECT_EQ(replies("tofray render --fro", 2), "--from\n");
  EXPECT_EQ(replies("tofray render bench-pr", 2), "bench-primitives\n");
  EXPECT_EQ(replies("tofray render --noise e", 3), "exact\n");
  EXPECT_EQ(replies("tofray render --noise = e", 4), "exact\n");
  EXPECT_EQ(replies("tofray render --noise = --seed 1", 3), "off exact\n");
  EXPECT_EQ(replies("tofray render --set camera.lens.f_", 3), "camera.lens.f_number=\n");
  EXPECT_EQ(replies("tofray render --set ambient.le", 3), "ambient.level=\n");
}

/// What `tofray complete` offers at the end of the words, without what it says about each.
std::vector<std::string> offered(Arguments words) {
  words.insert(words.begin(), {"complete", "--"});
  const Result result = run(words);
  EXPECT_EQ(result.code, 0);
  EXPECT_EQ(result.err, "");
  std::vector<std::string> out;
  std::istringstream lines(result.out);
  for (std::string line; std::getline(lines, line);) out.push_back(line.substr(0, line.find('\t')));
  return out;
}

TEST(completion, offers_what_the_tables_hold) {
  using Words = std::vector<std::string>;
  EXPECT_EQ(offered({"re"}), Words{"render"});
  EXPECT_EQ(offered({"--li"}), Words{"--limits"});
  EXPECT_EQ(offered({"help", "sch"}), Words{"schema"});
  EXPECT_EQ(offered({"check", "pico-flexx"}), (Words{"pico-flexx", ":files"}));
  EXPECT_EQ(offered({"render", "--theme", ""}), (Words{"dark", "light"}));
  EXPECT_EQ(offered({"render", "--theme=l"}), Words{"--theme=light"});
  EXPECT_EQ(offered({"render", "-o", ""}), Words{":files"});
  EXPECT_EQ(offered({"render", "--arrays", "raw,gt_mater"}), Words{"raw,gt_material_id"});
  EXPECT_EQ(offered({"render", "--emit", "npz,p"}), (Words{"npz,png", "npz,ply"}));
  EXPECT_EQ(offered({"render", "--mode", "MODE_9_5FPS_2"}), Words{"MODE_9_5FPS_2000"});
  EXPECT_EQ(offered({"render", "--seed", ""}), Words{});
  EXPECT_EQ(offered({"render", "--set", "ambient.level", "=", "5"}), Words{});
  EXPECT_EQ(offered({"render", "--", "--noise", "car"}), (Words{"card", ":files"}));  // behind "--" all are names
  EXPECT_EQ(offered({"nonsense", ""}), Words{});
  EXPECT_EQ(run({"complete"}).out + run({"complete", "--"}).out, "");
}

// Whatever is added to the tables is completed in all shells: their scripts only ask.
TEST(completion, offers_every_command_and_option_that_help_names) {
  std::vector<std::string> known = {"help", "version", "--help", "--version", "--limits"};
  known.insert(known.begin(), commands.begin(), commands.end());
  EXPECT_EQ(offered({""}), known);
  for (const std::string& command : commands) {
    std::vector<std::string> options;
    std::istringstream help(run({command, "--help"}).out);
    for (std::string line; std::getline(help, line);) {
      if ((line.starts_with("  -") && line.substr(4, 4) == ", --") || line.starts_with("      --"))
        options.push_back(line.substr(6, line.find(' ', 6) - 6));
    }
    options.emplace_back("--help");
    EXPECT_EQ(offered({command, "--"}), options);
  }
  for (const char* shell : {"bash", "zsh", "fish"}) {
    const std::string script = run({"completion", shell}).out;
    EXPECT_TRUE(has(script, "tofray complete -- ")) << shell;
    EXPECT_FALSE(has(script, "--seed")) << shell;
  }
}

TEST(completion, has_a_command_for_its_scripts_that_help_does_not_list) {
  EXPECT_FALSE(has(run({"--help"}).out, "\n  complete "));
  EXPECT_FALSE(has(run({"complet"}).err, "complete\""));
  EXPECT_TRUE(has(run({"complete", "--help"}).out, "Usage: tofray complete -- WORDS"));
}

}  // namespace
}  // namespace tofray::test
