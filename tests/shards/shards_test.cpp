// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Sets in files: the same bytes whoever makes them, what a shard holds, and what is found where something is wrong.
#include "tofray/shards.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "files/json.h"
#include "files/sha256.h"
#include "shards/canary.h"
#include "shards/layout.h"
#include "shards/record.h"
#include "shards/worker.h"
#include "small_set.h"
#include "support/samples.h"
#include "tofray/dataset.h"
#include "tofray/load.h"
#include "tofray/simulator.h"

namespace {

using namespace tofray;
using namespace tofray::test;
using out_test::error_of;
using out_test::Python;

TEST(shards, are_the_same_bytes_in_any_number_of_parts_and_threads) {
  EXPECT_EQ(undisturbed().size(), 8U * 2 + 12)
      << "tars and records; plan, sums, statistics, list, card, croissant, preview, five of the index";
  for (const auto& [parts, threads] : {std::pair<std::uint64_t, int>{1, 3}, {2, 1}, {7, 2}}) {
    const SmallSet set;
    for (std::uint64_t part = parts; part-- > 0;) set.run(part, parts, threads);
    merge_shards(set.out());
    EXPECT_EQ(published(set.out()), undisturbed()) << parts << " parts, " << threads << " threads";
    EXPECT_EQ(under_way(set.out()), 0U);
  }
}

TEST(shards, that_are_there_are_left_alone) {
  const SmallSet set;
  const ShardRunResult some = run_shards({set.out(), {0, 1, {2, 5}}, 1});
  EXPECT_EQ(some.made, 2U);
  EXPECT_EQ(some.samples, 10U);
  const ShardRunResult all = set.run();
  EXPECT_EQ(all.made, 6U);
  EXPECT_EQ(all.there, 2U);
  EXPECT_EQ(set.run().made, 0U);
}

TEST(shards, hold_what_rendering_the_samples_scene_gives) {
  SetText text;
  text.views = "2";
  const SmallSet set(text);
  set.run();
  const Dataset source((set.folder / "set.yaml").native());
  const std::optional<shards::Record> record = shards::read_record(set.out(), 3);
  ASSERT_TRUE(record);
  ASSERT_EQ(record->samples.size(), 10U);
  const std::string tar = content(set.out() / shards::tar_name(3));
  for (const shards::Record::Sample& one : record->samples) {
    const Scene scene = source.scene(one.sample, one.view);
    SimulatorOptions options;
    options.seed = source.noise_seed(one.sample, one.view), options.threads = 1;
    const Frame frame = Simulator(scene, load_camera(scene), options).frame(0);
    const auto member = [&](const std::string& name) {
      for (const shards::Record::Member& each : one.members)
        if (each.name == name) return tar.substr(each.offset, each.bytes);
      return std::string();
    };
    const auto same = [&](const std::string& name, const auto& data) {
      const files::NpyArray array = files::parse_npy(member(name + ".npy"), name);
      EXPECT_EQ(array.bytes, std::string(reinterpret_cast<const char*>(data.data()), data.size() * sizeof data[0]))
          << name << " of " << one.sample;
    };
    same("raw", frame.raw.raw), same("z_m", frame.depth.z_m), same("flags", frame.depth.flags), same("gt_z_m", frame.truth.z_m);
    const files::Json json = files::parse_json(member("json"), "json");
    EXPECT_EQ(*json.find("scene")->string(), source.scene_yaml(one.sample, one.view));
    EXPECT_EQ(json.find("numbers")->find("modulation_frequency_hz")->items()->size(), static_cast<std::size_t>(frame.raw.phases));
  }
}

TEST(summary, shows_samples_and_says_how_to_make_them_again) {
  SetText text;
  text.objects =
      "    - sphere: {name: lid, center: [0, 0, {choice: {10 m: 3, 0.11 m: 1}}], radius: 10 cm, reflectivity: 0.5}\n";  // now and then before the lens
  text.more = "holes: 50 %\n";
  const SmallSet set(text);
  set.run();
  merge_shards(set.out());
  const std::string card = content(set.out() / "card.md"), page = content(set.out() / "preview.html");
  for (const char* said : {"# small", "| licence | CC0-1.0 |", "`pico-flexx`, mode `MODE_", "| `gt_z_m` | float32 | 24 × 32 | m |",
                           "tofray.open_dataset(", "tofray dataset plan set.yaml -o again", "## The set's file\n\n```yaml\nname: small\n"})
    EXPECT_TRUE(has(card, said)) << said;
  std::size_t pictures = 0;
  for (std::size_t at = page.find("src=\"data:image/png;base64,iVBOR"); at != std::string::npos; at = page.find("src=\"data:", at + 1))
    ++pictures;
  EXPECT_EQ(pictures, 24U + 6U);
  EXPECT_FALSE(has(page, "://") || has(page, "<script")) << "nothing from elsewhere";
  // The worst sample is first of its part.
  std::uint64_t worst = 0, fewest = UINT64_MAX;
  for (std::uint64_t shard = 0; shard < 8; ++shard) {
    const auto record = shards::read_record(set.out(), shard);
    for (const auto& one : record->samples)
      if (one.valid < fewest) worst = one.sample, fewest = one.valid;
  }
  const std::string part = page.substr(page.find("Fewest valid pixels"));
  EXPECT_EQ(part.find("depth of sample " + std::to_string(worst) + "\""), part.find("depth of sample "));
  EXPECT_TRUE(has(part, "tofray dataset scene set.yaml " + std::to_string(worst)));
}

TEST(summary, tells_draws_that_miss_their_law) {
  SetText text;
  text.samples = "400", text.more = "split: {by: scene, test: 25 %}\n";
  const SmallSet set(text, 200);
  set.run();
  EXPECT_EQ(merge_shards(set.out()).missed_laws, "");
  const std::string card = content(set.out() / "card.md");
  EXPECT_TRUE(has(card, "| `objects/ball/radius` | uniform | 400 |")) << card;
  EXPECT_TRUE(has(card, "## Splits") && has(card, "| test | ") && !has(card, "| validation |"));
  // As a sampler would that draws the lower half of its law alone.
  for (std::uint64_t shard = 0; shard < 2; ++shard) {
    shards::Record record = *shards::read_record(set.out(), shard);
    auto& counts = record.statistics.draws.at("objects/ball/radius").counts;
    for (std::size_t i = 8; i < 16; ++i) counts[i - 8] += counts[i], counts[i] = 0;
    write(set.out() / shards::record_name(shard), shards::record_text(record));
  }
  const MergeResult merged = merge_shards(set.out());
  EXPECT_TRUE(has(merged.missed_laws, "objects/ball/radius (uniform): χ² 4")) << merged.missed_laws;
  EXPECT_TRUE(has(content(set.out() / "card.md"), "**misses its law**"));
  EXPECT_TRUE(has(content(set.out() / "preview.html"), "<strong>misses its law</strong>"));
}

TEST(summary, is_a_croissant_whose_sums_are_right) {
  const SmallSet set;
  set.run();
  merge_shards(set.out());
  const files::Json json = files::parse_json(content(set.out() / "croissant.json"), "croissant.json");
  EXPECT_EQ(*json.find("conformsTo")->string(), "http://mlcommons.org/croissant/1.0");
  const files::Json& first = json.find("distribution")->items()->at(0);
  EXPECT_EQ(*first.find("sha256")->string(), files::sha256_hex(content(set.out() / "SHA256SUMS")));
  std::set<std::string> fields;
  for (const files::Json& one : *json.find("recordSet")->items()->at(0).find("field")->items()) fields.insert(*one.find("name")->string());
  EXPECT_EQ(fields, (std::set<std::string>{"samples/flags.npy", "samples/gt_object_id.npy", "samples/gt_z_m.npy", "samples/json",
                                           "samples/raw.npy", "samples/z_m.npy"}));
}

TEST(summary, escapes_what_the_set_says) {
  SetText text;
  text.name = "'<img src=x onerror=alert(1)>'";
  const SmallSet set(text);
  set.run(0, 8);
  merge_shards(set.out(), true);
  const std::string page = content(set.out() / "preview.html");
  EXPECT_FALSE(has(page, "<img src=x"));
  EXPECT_TRUE(has(page, "&lt;img src=x onerror=alert(1)&gt;"));
}

TEST(labels, are_stored_with_objects_and_their_boxes) {
  const Python python;
  if (!python.there()) GTEST_SKIP() << "no python3 with numpy";
  SetText text;
  text.samples = "6";
  text.more = "arrays: [gt_object_id, gt_raw_dn, gt_raw_direct_dn, gt_phase_flow_px, '*_by_frequency*', gt_class_id]\n";
  text.objects =
      "    - box: {name: crate, class: thing, min: [-0.05, -0.02, 0.5], max: [0.01, 0.04, 0.56], reflectivity: 0.4, velocity: [0, "
      "{uniform: [-1, "
      "1]}, 0]}\n  transport: {bounces: 1, samples: 4}\n  classes: [wall, thing]\n";
  const SmallSet set(text);
  set.run();
  const char* const script = R"(
import io, json, pathlib, sys, tarfile
import numpy
seen = {}
for shard in sorted((pathlib.Path(sys.argv[1]) / "shards").glob("*/*.tar")):
    with tarfile.open(shard) as tar:
        for member in tar:
            key, name = member.name.split(".", 1)
            data = tar.extractfile(member)
            seen.setdefault(int(key), {})[name] = json.load(data) if name == "json" else numpy.load(io.BytesIO(data.read()))
assert len(seen) == 6
for sample in seen.values():
    about = sample["json"]
    phases, modulations = len(about["numbers"]["lit"]), len({f for f in about["numbers"]["modulation_frequency_hz"] if f})
    assert sample["gt_raw_dn.npy"].shape == sample["gt_raw_direct_dn.npy"].shape == (phases, 24, 32)
    assert sample["gt_phase_flow_px.npy"].shape == (phases, 24, 32, 2)
    for name in ("range_by_frequency_m", "amplitude_by_frequency_e", "cycle_by_frequency"):
        assert sample[name + ".npy"].shape == (modulations, 24, 32), name
    assert about["classes"] == ["wall", "thing"]
    wall, ball, crate = about["objects"]
    assert [one["name"] for one in (ball, crate)] == ["ball", "crate"] and [one["class"] for one in (wall, ball, crate)] == [None, None, "thing"]
    assert wall["low"] is None and wall["high"] is None
    ids = sample["gt_object_id.npy"]
    assert numpy.array_equal(sample["gt_class_id.npy"], numpy.where(ids == 2, 1, -1))
    for i, one in enumerate(about["objects"]):
        v, u = numpy.nonzero(ids == i)
        assert one["pixels"] == len(u)
        assert one["box_px"] == ([int(u.min()), int(v.min()), int(u.max()), int(v.max())] if len(u) else None)
    middle = [(a + b) / 2 for a, b in zip(crate["low"], crate["high"])]
    assert numpy.allclose(middle, crate["position"]) and crate["rotation"] == [0, 0, 0, 1]
    speed = about["drawn"]["objects/crate/velocity[1]"]["value"] if "objects/crate/velocity[1]" in about["drawn"] else next(one["value"] for key, one in about["drawn"].items() if "velocity" in key)
    assert abs(crate["position"][1] - (0.01 + speed * about["numbers"]["gt_time_s"])) < 1e-9
    flow = sample["gt_phase_flow_px.npy"]
    assert (flow[:, ids == 0] == 0).any() and not (flow == 0).all()
)";
  EXPECT_EQ(Python::run(script, set.out().native()), 0);
}

TEST(labels, want_the_classes_of_the_whole_set) {
  SetText text;
  text.objects = "    - box: {class: thing, min: [-0.05, -0.02, 0.5], max: [0.01, 0.04, 0.56], reflectivity: 0.4}\n";
  const std::string said = error_of([&] { const SmallSet set(text); }).what();
  EXPECT_TRUE(has(said, "objects have classes, and the scene does not list them")) << said;
}

TEST(shards, are_read_by_tarfile_and_numpy) {
  const Python python;
  if (!python.there()) GTEST_SKIP() << "no python3 with numpy";
  const SmallSet set;
  set.run();
  merge_shards(set.out());
  const char* const script = R"(
import hashlib, io, json, pathlib, sys, tarfile
import numpy
folder, seen = pathlib.Path(sys.argv[1]), {}
for line in (folder / "SHA256SUMS").read_text().splitlines():
    digest, name = line.split("  ")
    assert hashlib.sha256((folder / name).read_bytes()).hexdigest() == digest, name
for shard in sorted((folder / "shards").glob("*/*.tar")):
    with tarfile.open(shard) as tar:
        for member in tar:
            assert (member.mtime, member.uid, member.gid, member.mode) == (0, 0, 0, 0o644)
            key, name = member.name.split(".", 1)
            data = tar.extractfile(member)
            seen.setdefault(int(key), {})[name] = json.load(data) if name == "json" else numpy.load(io.BytesIO(data.read()))
            if name != "json":   # an array's numbers begin at a multiple of 64 bytes: it can be mapped into memory
                assert member.offset_data % 64 == 0
assert sorted(seen) == list(range(40))
for sample in seen.values():
    assert sorted(sample) == ["flags.npy", "gt_object_id.npy", "gt_z_m.npy", "json", "raw.npy", "z_m.npy"]
    assert sample["raw.npy"].dtype == numpy.uint16 and sample["raw.npy"].shape[1:] == (24, 32)
    for name, array in sample["json"]["arrays"].items():
        assert list(sample[name + ".npy"].shape) == array["shape"] and sample[name + ".npy"].dtype == array["dtype"]
statistics = json.loads((folder / "statistics.json").read_text())["statistics"]
assert statistics["valid"] == sum(int(numpy.isfinite(s["z_m.npy"]).sum()) for s in seen.values())
assert statistics["flags"]["low_signal"] == sum(int(((s["flags.npy"] & 2) != 0).sum()) for s in seen.values())
error = numpy.concatenate([(s["z_m.npy"].astype(float) - s["gt_z_m.npy"])[numpy.isfinite(s["z_m.npy"]) & numpy.isfinite(s["gt_z_m.npy"])] for s in seen.values()])
counts = numpy.bincount(numpy.clip(numpy.floor((error + 0.256) / 0.002), 0, 255).astype(int), minlength=256)
assert statistics["z_error_m"]["counts"] == counts.tolist()
shard, offset, size = (numpy.load(folder / "index" / f"{name}.npy", mmap_mode="r") for name in ("shard", "offset", "bytes"))
members = json.loads((folder / "index" / "index.json").read_text())["members"]
for row in (0, 17, 39):
    at = members.index("gt_z_m.npy")
    path = folder / "shards" / f"{shard[row] // 1000:03}" / f"{shard[row]:06}.tar"
    bytes_ = path.read_bytes()[int(offset[row, at]):int(offset[row, at] + size[row, at])]
    assert bytes_[:8] == numpy.lib.format.magic(1, 0)
    assert numpy.array_equal(numpy.frombuffer(bytes_[-24 * 32 * 4:], "<f4").reshape(24, 32), seen[row]["gt_z_m.npy"], equal_nan=True)
)";
  EXPECT_EQ(Python::run(script, set.out().native()), 0);
}

TEST(plan, of_the_same_set_changes_nothing) {
  const SmallSet set;
  const std::string before = content(set.out() / "plan.json");
  // Comments, blanks and another order of maps that have none: the same set.
  write(set.folder / "set.yaml", "# a note\n" + SetText().text() + "\n\n");
  const DatasetPlan plan = plan_dataset({(set.folder / "set.yaml").native(), set.out()});
  EXPECT_EQ(plan.found, DatasetPlan::Found::same);
  EXPECT_EQ(content(set.out() / "plan.json"), before);
}

TEST(plan, with_more_samples_keeps_the_shards_that_are_whole) {
  SetText text;
  text.samples = "13";
  const SmallSet few(text);
  few.run();
  const auto before = published(few.out());
  text.samples = "40";
  write(few.folder / "set.yaml", text.text());
  const DatasetPlan plan = plan_dataset({(few.folder / "set.yaml").native(), few.out()});
  EXPECT_EQ(plan.found, DatasetPlan::Found::fewer_samples);
  EXPECT_EQ(plan.shards, 8U);
  EXPECT_EQ(dataset_status(few.out()).complete, 2U) << "the third had three samples of five";
  EXPECT_EQ(few.run().made, 6U);
  merge_shards(few.out());
  const auto after = published(few.out());
  for (const auto& [name, bytes] : undisturbed()) {
    if (name.ends_with(".tar")) {
      EXPECT_EQ(after.at(name), bytes) << name;
    }
  }
  EXPECT_EQ(after.at("shards/000/000001.json"), before.at("shards/000/000001.json"));
}

TEST(plan, that_is_another_one_is_refused_with_what_differs) {
  struct Case {
    std::function<void(SetText&)> change;
    std::string differs;
  };
  const std::vector<Case> cases = {
      {[](SetText& t) { t.seed = "6"; }, "seed of the set"},
      {[](SetText& t) { t.name = "other"; }, "name of the set"},
      {[](SetText& t) { t.license = "MIT"; }, "license of the set"},
      {[](SetText& t) { t.views = "2"; }, "views of the set"},
      {[](SetText& t) { t.samples = "39"; }, "it has 40 samples, the set has 39"},
      {[](SetText& t) { t.radius = "{uniform: [5 cm, 16 cm]}"; }, "scene.objects.1.sphere.radius.uniform.1 of the set"},
      {[](SetText& t) { t.radius = "{normal: [5 cm, 1 cm]}"; }, "scene.objects.1.sphere.radius.uniform of the set"},
      {[](SetText& t) { t.radius = "10 cm"; }, "scene.objects.1.sphere.radius of the set"},
      {[](SetText& t) { t.objects = "    - sphere: {center: [0, 0, 1], radius: 1 cm, reflectivity: 0.1}\n"; }, "scene.objects of the set"},
      {[](SetText& t) { t.more = "arrays: [raw]\n"; }, "arrays of the set"},
      {[](SetText& t) { t.more = "holes: 1 %\n"; }, "holes of the set"},
      {[](SetText& t) { t.more = "let: {a: 1 m}\n"; }, "let of the set"},
  };
  const SmallSet set;
  const std::string before = content(set.out() / "plan.json");
  for (const Case& one : cases) {
    SetText text;
    one.change(text);
    write(set.folder / "set.yaml", text.text());
    const Error error = error_of([&] { plan_dataset({(set.folder / "set.yaml").native(), set.out()}); });
    EXPECT_EQ(error.kind(), ErrorKind::bad_input);
    EXPECT_TRUE(has(error.what(), one.differs)) << error.what();
    EXPECT_EQ(content(set.out() / "plan.json"), before);
  }
  SetText even;
  even.radius = "{even: [5 cm, 15 cm]}";
  const SmallSet counted(even);
  even.samples = "50";
  write(counted.folder / "set.yaml", even.text());
  EXPECT_TRUE(has(error_of([&] {
                    plan_dataset({(counted.folder / "set.yaml").native(), counted.out()});
                  }).what(),
                  "a value by `even` is another one"));
}

TEST(plan, that_was_edited_is_refused) {
  const SmallSet set;
  const std::string plan = content(set.out() / "plan.json");
  for (const auto& [from, to] : std::vector<std::pair<std::string, std::string>>{{"seed: 5", "seed: 6"},
                                                                                 {"\"shard_samples\": 5", "\"shard_samples\": 4"},
                                                                                 {"\"gt_z_m\"", "\"gt_range_m\""},
                                                                                 {"15 cm", "16 cm"}}) {
    std::string other = plan;
    other.replace(other.find(from), from.size(), to);
    write(set.out() / "plan.json", other);
    EXPECT_TRUE(has(error_of([&] { set.run(); }).what(), "plan.json: error: its id is not what a plan has")) << from;
  }
  for (const std::string& other : {std::string(), std::string("{}"), plan.substr(0, plan.size() / 2), std::string("[1]")}) {
    write(set.out() / "plan.json", other);
    EXPECT_EQ(error_of([&] { set.run(); }).kind(), ErrorKind::bad_input);
  }
}

TEST(plan, whose_frame_comes_out_otherwise_here_is_refused_before_anything_is_written) {
  const SmallSet set;
  shards::Plan plan = shards::load_plan(set.out());
  plan.canary[0] = plan.canary[0] == '0' ? '1' : '0';
  plan.id = shards::id_of(plan, shards::scenes_of(shards::load_plan(set.out()), set.out())->set().laws);
  write(set.out() / "plan.json", shards::plan_text(plan, {}));
  const Error error = error_of([&] { set.run(); });
  EXPECT_EQ(error.kind(), ErrorKind::bad_input);
  EXPECT_TRUE(has(error.what(), "this tofray makes other bytes than the one that made the plan")) << error.what();
  EXPECT_TRUE(has(error.what(), plan.canary)) << error.what();
  EXPECT_FALSE(fs::exists(set.out() / "shards"));
}

TEST(plan, finds_a_file_that_was_replaced) {
  const auto tetrahedron = [](double top) {
    return "v 0 0 0\nv 0.1 0 0\nv 0 0 0.1\nv 0 " + std::to_string(top) + " 0\nf 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n";
  };
  SetText text;
  text.objects =
      "    - mesh: {file: {files: \"parts/*.obj\"}, position: [0, 0, 70 cm], reflectivity: 0.5}\n    - mesh: {file: fixed.obj, position: "
      "[0, 0.2, 60 cm], reflectivity: 0.5}\n";
  Folder folder;
  fs::create_directories(folder / "parts");
  write(folder / "parts/a.obj", tetrahedron(0.1)), write(folder / "parts/b.obj", tetrahedron(0.2)),
      write(folder / "fixed.obj", tetrahedron(0.05));
  write(folder / "set.yaml", text.text());
  plan_dataset({(folder / "set.yaml").native(), folder / "out", 2, 5, 1});
  run_shards({folder / "out", {0, 1, {0}}, 1});
  EXPECT_TRUE(has(content(folder / "out/plan.json"), "\"parts/b.obj\""));
  EXPECT_FALSE(has(content(folder / "out/plan.json"), folder.path().native())) << "a set says nothing of where it was made";
  write(folder / "parts/b.obj", tetrahedron(0.3));
  const Error drawn = error_of([&] { run_shards({folder / "out", {0, 1, {1}}, 1}); });
  EXPECT_TRUE(has(drawn.what(), "parts/b.obj: error: this file is another one than at the plan")) << drawn.what();
  EXPECT_TRUE(has(error_of([&] {
                    plan_dataset({(folder / "set.yaml").native(), folder / "out"});
                  }).what(),
                  "the file \"parts/b.obj\" is another one now"));
  write(folder / "parts/b.obj", tetrahedron(0.2)), write(folder / "fixed.obj", tetrahedron(0.06));
  const Error named = error_of([&] { run_shards({folder / "out", {0, 1, {1}}, 1}); });
  EXPECT_TRUE(has(named.what(), "fixed.obj: error: sample 5 read another file than the plan did")) << named.what();
  EXPECT_EQ(dataset_status(folder / "out").complete, 1U);
}

TEST(holes, are_told_with_their_reason_and_never_renumbered) {
  SetText text;
  text.radius = "{choice: {10 cm: 3, 0 cm: 1}}";  // less than a radius may have
  text.more = "holes: 60 %\n";
  Folder folder;
  write(folder / "set.yaml", text.text());
  // The pilot's samples have to be good.
  const Dataset set((folder / "set.yaml").native());
  std::set<std::uint64_t> bad;
  for (std::uint64_t i = 0; i < 40; ++i)
    if (set.drawn(i)[4].text == "0 cm") bad.insert(i);
  ASSERT_FALSE(bad.empty());
  ASSERT_FALSE(bad.contains(0)) << "another seed, so that the pilot is good";
  plan_dataset({(folder / "set.yaml").native(), folder / "out", 1, 5, 1});
  const ShardRunResult result = run_shards({folder / "out", {}, 2});
  EXPECT_EQ(result.holes, bad.size());
  EXPECT_FALSE(result.too_many_holes);
  const MergeResult merged = merge_shards(folder / "out");
  EXPECT_EQ(merged.holes, bad.size());
  EXPECT_EQ(merged.samples, 40 - bad.size());
  std::set<std::uint64_t> told;
  for (std::uint64_t shard = 0; shard < 8; ++shard)
    for (const shards::Record record = *shards::read_record(folder / "out", shard); const shards::Record::Hole& hole : record.holes) {
      told.insert(hole.sample);
      EXPECT_TRUE(has(hole.why, "radius") && has(hole.why, "set.yaml:")) << hole.why;
      EXPECT_FALSE(has(hole.why, folder.path().native())) << hole.why;
    }
  EXPECT_EQ(told, bad);
  const files::NpyArray shard = files::read_npy((folder / "out/index/shard.npy").native());
  for (std::uint64_t i = 0; i < 40; ++i) EXPECT_EQ(shard.number(i), bad.contains(i) ? 4294967295.0 : static_cast<double>(i / 5)) << i;
  text.more = "holes: 1 %\n";
  write(folder / "set.yaml", text.text());
  plan_dataset({(folder / "set.yaml").native(), folder / "strict", 1, 5, 1});
  EXPECT_TRUE(run_shards({folder / "strict", {}, 2}).too_many_holes);
}

TEST(holes, are_samples_that_lack_an_array_of_the_others) {
  SetText text;
  text.more = "arrays: [raw, gt_multipath_m]\nholes: 100 %\n";
  std::string yaml = text.text();
  yaml.replace(yaml.find("  objects:\n"), 0, "  transport: {bounces: {choice: [0, 1]}, samples: 1}\n");
  Folder folder;
  write(folder / "set.yaml", yaml);
  const Error error = error_of([&] { plan_dataset({(folder / "set.yaml").native(), folder / "out", 8, 5, 1}); });
  EXPECT_TRUE(has(error.what(), "do not all have the same arrays")) << error.what();
  EXPECT_FALSE(fs::exists(folder / "out"));
}

TEST(verify, finds_every_byte_that_changed_and_run_makes_these_shards_again) {
  const SmallSet set;
  set.run();
  const auto before = published(set.out());
  out_test::Random random(3);
  constexpr int flips = 1000;
  int found = 0;
  for (int i = 0; i < flips; ++i) {
    const std::uint64_t shard = random.below(8);
    const fs::path tar = set.out() / shards::tar_name(shard);
    std::string bytes = content(tar);
    const std::size_t at = random.below(bytes.size());
    bytes[at] = static_cast<char>(bytes[at] ^ (1 << random.below(8)));
    write(tar, bytes);
    const VerifyResult result = verify_shards({set.out(), {0, 1, {shard}}, 0, 1});
    ASSERT_EQ(result.faults.size(), 1U) << shard << " " << at;
    // Where it lies in a member, that member is named.
    const shards::Record record =
        shards::parse_record(content(fs::path((set.out() / shards::record_name(shard)).native() + ".damaged")), "record");
    std::vector<std::string> members;
    for (const shards::Record::Sample& sample : record.samples)
      for (const shards::Record::Member& member : sample.members)
        if (at >= member.offset && at < member.offset + member.bytes)
          members.push_back(shards::sample_key(sample.sample, 0, 1) + "." + member.name);
    found += result.faults[0].members == members ? 1 : 0;
    write(tar, before.at(shards::tar_name(shard)));
    fs::rename((set.out() / shards::record_name(shard)).native() + ".damaged", set.out() / shards::record_name(shard));
  }
  EXPECT_EQ(found, flips);
  // Truncated, empty, zeroed, swapped, without a tar, a record of another plan, a torn record.
  const auto path = [&](std::uint64_t shard) { return set.out() / shards::tar_name(shard); };
  const auto record = [&](std::uint64_t shard) { return set.out() / shards::record_name(shard); };
  write(path(0), before.at(shards::tar_name(0)).substr(0, 5000)), write(path(1), "");
  write(path(2), std::string(before.at(shards::tar_name(2)).size(), '\0'));
  write(path(3), before.at(shards::tar_name(4)));
  fs::remove(path(5));
  std::string other = before.at(shards::record_name(6));
  other.replace(other.find("\"plan\":\"") + 8, 4, "0000");
  write(record(6), other), write(record(7), before.at(shards::record_name(7)).substr(0, 300));
  const VerifyResult result = verify_shards({set.out(), {}, 0, 2});
  std::set<std::uint64_t> faulty;
  for (const ShardFault& one : result.faults) faulty.insert(one.shard);
  EXPECT_EQ(faulty, (std::set<std::uint64_t>{0, 1, 2, 3, 5, 6, 7}));
  EXPECT_EQ(set.run().made, 7U);
  for (std::uint64_t shard = 0; shard < 8; ++shard) fs::remove(record(shard).native() + ".damaged");
  EXPECT_EQ(published(set.out()), before);
  EXPECT_TRUE(verify_shards({set.out(), {}, 0, 1}).faults.empty());
}

TEST(verify, computes_samples_again_and_finds_bytes_that_a_record_agrees_with) {
  const SmallSet set;
  set.run();
  EXPECT_EQ(verify_shards({set.out(), {}, 1, 2}).recomputed, 40U);
  const std::uint64_t some = verify_shards({set.out(), {}, 0.3, 2}).recomputed;
  EXPECT_GT(some, 3U);
  EXPECT_LT(some, 25U);
  // A machine that computed a wrong number and wrote it well: the last float of gt_z_m of sample 12.
  shards::Record record = *shards::read_record(set.out(), 2);
  std::string tar = content(set.out() / shards::tar_name(2));
  const shards::Record::Member& member = record.samples[2].members[3];
  ASSERT_EQ(member.name, "gt_z_m.npy");
  tar[member.offset + member.bytes - 1] = static_cast<char>(tar[member.offset + member.bytes - 1] ^ 1);
  write(set.out() / shards::tar_name(2), tar);
  record.sha256 = files::sha256_hex(tar);
  write(set.out() / shards::record_name(2), shards::record_text(record));
  EXPECT_TRUE(verify_shards({set.out(), {}, 0, 1}).faults.empty());
  const VerifyResult result = verify_shards({set.out(), {}, 1, 2});
  ASSERT_EQ(result.faults.size(), 1U);
  EXPECT_EQ(result.faults[0].members, std::vector<std::string>{"000000012.gt_z_m.npy"});
}

TEST(merge, refuses_a_set_with_missing_shards_unless_it_is_told) {
  const SmallSet set;
  run_shards({set.out(), {0, 1, {0, 1, 3}}, 1});
  const Error error = error_of([&] { merge_shards(set.out()); });
  EXPECT_TRUE(has(error.what(), "5 of 8 shards are missing, 2 the first of them")) << error.what();
  EXPECT_FALSE(fs::exists(set.out() / "SHA256SUMS"));
  EXPECT_EQ(merge_shards(set.out(), true).samples, 15U);
  set.run();
  merge_shards(set.out());
  EXPECT_EQ(published(set.out()), undisturbed());
}

TEST(merge, refuses_shards_that_read_different_files_of_one_name) {
  const SmallSet set;
  set.run();
  for (const std::uint64_t shard : {1, 6}) {
    shards::Record record = *shards::read_record(set.out(), shard);
    record.inputs["chair.obj"] = std::string(64, static_cast<char>('a' + shard));
    write(set.out() / shards::record_name(shard), shards::record_text(record));
  }
  EXPECT_TRUE(has(error_of([&] { merge_shards(set.out()); }).what(), "chair.obj: error: shards 1 and 6 read different files of this name"));
}

TEST(status, names_samples_that_three_processes_did_not_survive) {
  const SmallSet set;
  fs::create_directories(set.out() / "log");
  for (int process = 0; process < 3; ++process)
    write(set.out() / "log" / ("host-" + std::to_string(process) + ".log"),
          "begin 3\ndone 3\nbegin 17\nbegin 4\n" + std::string(process == 1 ? "done 4\n" : ""));
  write(set.out() / "log/host-9.log", "begin 17\nend\n");
  EXPECT_EQ(dataset_status(set.out()).deadly, std::vector<std::uint64_t>{17});
}

TEST(choice, of_parts_and_shards_is_checked) {
  const SmallSet set;
  EXPECT_TRUE(has(error_of([&] { set.run(4, 4); }).what(), "there is no part 4 of 4"));
  EXPECT_TRUE(has(error_of([&] { run_shards({set.out(), {0, 1, {8}}, 1}); }).what(), "there is no shard 8"));
  EXPECT_TRUE(has(error_of([&] { run_shards({set.folder / "nowhere", {}, 1}); }).what(), "there is no plan in this folder"));
  EXPECT_EQ(run_shards({set.out(), {1, 4, {1, 5, 5, 2}}, 1}).made, 2U);
}

TEST(canary, is_the_same_frame_each_time) { EXPECT_EQ(shards::canary_sha256(), shards::canary_sha256()); }

}  // namespace
