// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Scenes and profiles of somebody who means harm.
#include <zlib.h>

#include "attack.h"

namespace tofray::test {
namespace {

TEST(hostile_yaml, a_dotted_key_of_400000_parts_is_over_a_limit_and_no_signal) {
  const Folder folder;
  const auto scene = [](int parts) {
    return "camera:\n  profile: pico-flexx\n  ? " + repeated(parts - 1, [](int) { return "lens."; }) + "b\n  : 1\n" + wall_yaml;
  };
  write(folder / "deep.yaml", scene(400'000));
  expect_refused(attack(folder, {"check", "deep.yaml"}), 4, "the key has too many parts");
  const auto most = static_cast<int>(base::limit::nesting_depth.value);
  write(folder / "deep.yaml", scene(most + 1));
  expect_refused(attack(folder, {"check", "deep.yaml"}), 4, "got 65, at most 64");
  write(folder / "deep.yaml", scene(most));
  expect_refused(attack(folder, {"check", "deep.yaml"}), 2, "unknown key \"lens\"");
}

TEST(hostile_yaml, aliases_and_anchors_take_no_more_memory_than_a_file_may_have) {
  const Folder folder;
  write(folder / "text.yaml", "x: &a " + std::string(8000, 'b') + "\nobjects: [" + repeated(390'000, [](int) { return "*a,"; }) + "]\n");
  // 60 anchors around the same values: each keeps them all.
  write(folder / "anchors.yaml", "x: " + repeated(60, [](int i) { return "&a" + std::to_string(i) + " ["; }) +
                                     repeated(300'000, [](int) { return "1,"; }) + std::string(60, ']') + "\n" + wall_yaml);
  for (const char* name : {"text.yaml", "anchors.yaml"}) {
    const Attack result = attack(folder, {"check", name});
    expect_refused(result, 4, name[0] == 't' ? "too much text" : "too many values");
    // 400,000 values of about 200 bytes, twice where a list grows; the file; the program. 3.2 GB and 4 GB without the limits.
    EXPECT_LT(result.peak_bytes, most_memory(400'000'000)) << name;
  }
}

TEST(hostile_yaml, packed_by_gzip_is_no_text_and_is_not_unpacked) {
  const Folder folder;
  {
    const std::string text = wall_yaml + std::string(300'000'000, '#');
    const gzFile file = ::gzopen((folder / "scene.yaml").c_str(), "wb");
    ASSERT_NE(file, nullptr);
    EXPECT_EQ(::gzwrite(file, text.data(), static_cast<unsigned>(text.size())), static_cast<int>(text.size()));
    ASSERT_EQ(::gzclose(file), Z_OK);
  }
  const Attack result = attack(folder, {"check", "scene.yaml"});
  expect_refused(result, 2, "scene.yaml: error: this is a compressed file, not a scene");
  EXPECT_LT(result.peak_bytes, most_memory(64L << 20));
}

TEST(hostile_yaml, a_name_is_at_most_as_long_as_the_limit_and_does_not_make_pictures_larger) {
  const Folder folder;
  const auto most = static_cast<std::size_t>(base::limit::text_bytes.value);
  for (const std::size_t length : {most, most + 1, std::size_t{100'000}}) {
    write(folder / "camera.yaml", changed(pico_yaml, "name: pico-flexx", "name: " + std::string(length, 'n')));
    write(folder / "scene.yaml", "camera: {profile: camera.yaml}\n" + wall_yaml);
    const Attack result = attack(folder, with_small_sensor({"render", "scene.yaml", "-o", "out"}));
    if (length > most) {
      expect_refused(result, 4, "name is too long");
      EXPECT_FALSE(fs::exists(folder / "out"));
      continue;
    }
    EXPECT_EQ(result.code, 0) << result.err;
    const std::string png = content(folder / "out" / "preview.png");
    fs::remove_all(folder / "out");
    ASSERT_GT(png.size(), 24U);
    const auto byte = [&](std::size_t i) { return static_cast<unsigned>(static_cast<unsigned char>(png[i])); };
    EXPECT_LT(byte(16) << 24 | byte(17) << 16 | byte(18) << 8 | byte(19), 1700U) << "pixels of its width";
  }
}

TEST(hostile_yaml, many_faults_and_many_keys_end_soon) {
  const Folder folder;
  const auto sphere = [](int i) { return "  - sphere: {center: [0, 0, 1], radius: 0.1 m, material: q" + std::to_string(i) + "}\n"; };
  const auto material = [](int i) { return "  m" + std::to_string(i) + std::string(50, 'x') + ": {brdf: lambert, reflectivity: 0.5}\n"; };
  write(folder / "overrides.yaml", "camera:\n  profile: pico-flexx\n" +
                                       repeated(often(40'000), [](int i) { return "  lens.k" + std::to_string(i) + ": 1\n"; }) + wall_yaml);
  write(folder / "strangers.yaml", "camera:\n  profile: pico-flexx\n" +
                                       repeated(often(40'000), [](int i) { return "  k" + std::to_string(i) + ": 1\n"; }) + wall_yaml);
  write(folder / "materials.yaml", "materials:\n" + repeated(often(10'000), material) + "objects:\n" + repeated(often(20'000), sphere));
  write(folder / "keys.yaml", repeated(often(190'000), [](int i) { return "k" + std::to_string(i) + ": 1\n"; }));
  expect_refused(attack(folder, {"check", "overrides.yaml"}), 4,
                 "too many keys are changed\n  got " + std::to_string(often(40'000)) + ", at most 1000");
  expect_refused(attack(folder, {"check", "strangers.yaml"}), 4, "too many keys are changed");
  expect_refused(attack(folder, {"check", "materials.yaml"}), 2, "it was not read to its end");
  expect_refused(attack(folder, {"check", "keys.yaml"}), 2, "it was not read to its end");
}

TEST(hostile_yaml, eight_flat_tops_of_4096_by_4096_cells_are_over_a_limit) {
  const Folder folder;
  for (const auto& [columns, rows, code] : {std::tuple{4096, 4096, 4}, {1024, 1025, 4}, {1024, 1024, 0}}) {
    const std::string profile =
        changed(changed(pico_yaml, "columns: 172", "columns: " + std::to_string(columns)), "rows: 168", "rows: " + std::to_string(rows));
    ASSERT_FALSE(profile.empty());
    write(folder / "camera.yaml", profile);
    const Attack result = attack(folder, {"check", "camera.yaml"});
    if (code == 0) {
      EXPECT_EQ(result.code, 0) << result.err;
    } else {
      expect_refused(result, 4, "the pattern has too many samples");
    }
  }
}

/// The profile with that many modes in place of its own.
std::string with_modes(const std::string& profile, int count) {
  const std::size_t modes = profile.find("\nmodes:\n");
  EXPECT_NE(modes, std::string::npos);
  return profile.substr(0, modes) + "\nmodes:\n" + repeated(count, [](int i) {
           return "  m" + std::to_string(i) +
                  ": {frame_rate: 5 Hz, sequence: [{modulation_frequency: 80 MHz, reference_phase: [0 deg, 90 deg, 180 deg, 270 deg], "
                  "integration_time: {value: 1 ms, source: x}}]}\n";
         });
}

// 0.2 s, without light sources whose set-up would take more; 8 s where the profile is read anew for each mode.
TEST(hostile_yaml, as_many_modes_as_there_may_be_are_read_once) {
  const Folder folder;
  write(folder / "camera.yaml", with_modes(pico_yaml, static_cast<int>(base::limit::modes.value)));
  const Attack result = attack(folder, {"check", "camera.yaml", "--set", "illumination=[]"});
  EXPECT_EQ(result.code, 0) << result.err.substr(0, 500);
  EXPECT_TRUE(has(result.out, "256 modes")) << result.out;
  EXPECT_LT(result.processor_seconds, with_sanitizers ? 20 : 2);
}

// Tables by pixel are those of the sensor, made once: fifteen more modes cost less than five more tables would.
TEST(hostile_yaml, megapixels_in_many_modes_cost_those_of_one) {
  const Folder folder;
  const std::string large = changed(changed(pico_yaml, "width: 224", "width: 2000"), "height: 172", "height: 1500");
  const auto seconds = [&](int count) {
    write(folder / "camera.yaml", with_modes(large, count));
    const Attack result = attack(folder, {"check", "camera.yaml"});
    EXPECT_EQ(result.code, 0) << result.err;
    return result.processor_seconds;
  };
  const double one = seconds(1), many = seconds(16);
  EXPECT_LT(many, 6 * one + 1);
}

TEST(hostile_message, what_is_quoted_is_cut) {
  const Folder folder;
  write(
      folder / "names.yaml",
      "materials:\n" +
          repeated(20, [](int i) { return "  m" + std::to_string(i) + std::string(900, 'x') + ": {brdf: lambert, reflectivity: 0.5}\n"; }) +
          "objects:\n" +
          repeated(60, [](int i) { return "  - sphere: {center: [0, 0, 1], radius: 0.1 m, material: q" + std::to_string(i) + "}\n"; }));
  write(folder / "duplicates.yaml", std::string(50'000, 'k') + ": 1\n" + std::string(50'000, 'k') + ": 1\n");
  for (const char* name : {"names.yaml", "duplicates.yaml"}) expect_refused(attack(folder, {"check", name}), 2, "error: ");
  expect_refused(attack(folder, {"render", std::string(50'000, 'f')}), 3, "error: ");
  expect_refused(attack(folder, {"render", "card", "--set", std::string(100'000, 'f') + "=1"}), 2, "error: ");
  expect_refused(attack(folder, {std::string(100'000, 'c')}), 2, "error: ");
  expect_refused(attack(folder, {"render", "--" + std::string(100'000, 'c')}), 2, "error: ");
}

}  // namespace
}  // namespace tofray::test
