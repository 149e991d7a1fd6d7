// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Files cut short or changed anywhere: an error or a sound model, nothing else.
#include "everything.h"
#include "support/sanitizers.h"
#include "support/told.h"

using namespace tofray;
using namespace tofray::gltf_test;

namespace {

/// Whether parts may be handed on: finite vertices, indices within them, as many of each attribute.
void expect_sound(const std::vector<Part>& parts) {
  for (const Part& part : parts) {
    const std::size_t vertices = part.mesh.vertices.size();
    for (const auto& vertex : part.mesh.vertices)
      for (const float x : vertex) ASSERT_TRUE(std::isfinite(x));
    for (const auto& triangle : part.mesh.triangles)
      for (const std::int32_t i : triangle) ASSERT_TRUE(i >= 0 && static_cast<std::size_t>(i) < vertices);
    for (const std::size_t size : {part.normals.size(), part.texcoords[0].size(), part.texcoords[1].size(), part.colors.size()})
      ASSERT_TRUE(size == 0 || size == vertices);
    for (const auto& normal : part.normals)
      for (const float x : normal) ASSERT_TRUE(std::isfinite(x));
  }
}

gltf::Resources small_file() {
  return [](const std::string&, std::size_t) { return std::string(700, '\x3F'); };
}

/// Whether bytes give a model, which then is sound at any time; else an error that may be shown and names the file.
bool is_taken(const std::string& bytes) {
  try {
    const Model model = read("hostile", bytes, small_file());
    for (int scene = 0; scene < static_cast<int>(model.scenes.size()); ++scene)
      expect_sound(gltf::parts(model, gltf::at(model, gltf::none, 0, scene)));
    for (int animation = 0; animation < static_cast<int>(model.animations.size()); ++animation)
      for (const double time : {-1.0, 0.3, 1e300}) expect_sound(gltf::parts(model, gltf::at(model, animation, time)));
    return true;
  } catch (const Error& error) {
    test::expect_told(error, "hostile");
    return false;
  }
}

std::vector<std::string> samples() { return {triangle_file().text(), triangle_file().glb(), everything_file().glb()}; }

}  // namespace

TEST(hostile_gltf, cut_short_anywhere_is_an_error) {
  for (const std::string& sample : samples()) {
    ASSERT_TRUE(is_taken(sample));
    for (std::size_t size = 0; size < sample.size(); ++size) EXPECT_FALSE(is_taken(sample.substr(0, size))) << size;
  }
}

TEST(hostile_gltf, with_any_byte_changed_is_an_error_or_sound) {
  constexpr std::size_t step = test::with_sanitizers ? 5 : 1;
  std::size_t taken = 0, refused = 0;
  for (const std::string& sample : samples())
    for (std::size_t at = 0; at < sample.size(); at += step)
      for (const char byte : {'\0', '\xFF', '\x7F', '\x80', '\n', ' ', '-', '9', '0', '"', '[', '}', 'e'}) {
        std::string changed = sample;
        changed[at] = byte;
        SCOPED_TRACE(at);
        (is_taken(changed) ? taken : refused) += 1;
      }
  EXPECT_GT(taken, 5000U / step);
  EXPECT_GT(refused, 5000U / step);
}

TEST(hostile_gltf, with_many_changes_is_an_error_or_sound) {
  out_test::Random random(7);
  const std::vector<std::string> all = samples();
  for (int trial = 0; trial < test::often(20'000); ++trial) {
    std::string changed = all[random.below(all.size())];
    for (std::size_t changes = 1 + random.below(5); changes > 0; --changes) {
      const std::size_t at = random.below(changed.size()), from = random.below(changed.size()), size = random.below(20);
      if (random.below(2) == 0)
        changed[at] = static_cast<char>(random.next());
      else
        changed.replace(at, random.below(2) == 0 ? size : random.below(20), changed.substr(from, size));
      if (changed.empty()) changed = "g";
    }
    SCOPED_TRACE(trial);
    (void)is_taken(changed);
  }
}

/// Changes that stay JSON: other numbers, lists and objects in the places of numbers and of one another.
TEST(hostile_gltf, with_other_values_is_an_error_or_sound) {
  out_test::Random random(11);
  const File file = everything_file();
  const Document flat = file.with_buffer("").flatten();
  std::vector<std::string> places;
  for (const auto& [place, value] : flat.items()) places.push_back(place);
  const std::vector<Document> values = {0, 1, 2, 3, 5, 7, 12, 5121, 5123, 5125, 5126, -1, 0.5, 1e9, 1e308, -1e308, "", "VEC4", true};
  std::size_t taken = 0;
  for (int trial = 0; trial < test::often(4000); ++trial) {
    Document flattened = flat;
    for (std::size_t changes = 1 + random.below(3); changes > 0; --changes) {
      const std::string& place = places[random.below(places.size())];
      flattened[place] = random.below(3) == 0 ? flat.at(places[random.below(places.size())]) : values[random.below(values.size())];
    }
    File changed = file;
    changed.json = flattened.unflatten();
    SCOPED_TRACE(trial);
    if (is_taken(changed.glb())) ++taken;
  }
  EXPECT_GT(taken, static_cast<std::size_t>(test::often(200)));
}
