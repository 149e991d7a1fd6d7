// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// How numbers are written: types, strides, offsets, shares of whole numbers, sparse accessors.
#include "gltf_files.h"

using namespace tofray;
using namespace tofray::gltf_test;

namespace {

/// What a file's texture coordinates are read as: they may be of any type but 32 bits.
std::vector<float> texcoords_of(const File& file) { return *model_of(file).meshes[0].primitives[0].texcoords[0]; }

template <class T>
std::vector<float> as_texcoords(const std::vector<T>& six, bool normalized) {
  File file;
  file.mesh({{"POSITION", file.floats(corner_positions, "VEC3")}, {"TEXCOORD_0", file.accessor<T>(six, "VEC2", normalized)}});
  return texcoords_of(file);
}

template <class T>
Triangles by_indices(const std::vector<T>& indices) {
  File file = triangle_file();
  file.primitive(0)["indices"] = file.accessor<T>(indices, "SCALAR");
  return parts_at_rest(model_of(file))[0].mesh.triangles;
}

File with_sparse(bool base) {
  File file;
  const int positions = file.floats(corner_positions, "VEC3");
  const int indices = file.view(bytes_of<std::uint16_t>({9, 0, 2})), values = file.view(bytes_of<float>({5, 6, 7, 8, 9, 10}));
  file.json["accessors"][0]["sparse"] = {{"count", 2},
                                         {"indices", {{"bufferView", indices}, {"byteOffset", 2}, {"componentType", 5123}}},
                                         {"values", {{"bufferView", values}}}};
  if (!base) file.json["accessors"][0].erase("bufferView");
  file.mesh({{"POSITION", positions}});
  file.node({{"mesh", 0}});
  return file;
}

}  // namespace

TEST(accessor, has_numbers_of_any_type) {
  EXPECT_EQ(as_texcoords<float>({0, 0.25F, -3, 1e30F, 5, 6}, false), (std::vector<float>{0, 0.25F, -3, 1e30F, 5, 6}));
  EXPECT_EQ(as_texcoords<std::int8_t>({0, 1, -128, 127, 5, -6}, false), (std::vector<float>{0, 1, -128, 127, 5, -6}));
  EXPECT_EQ(as_texcoords<std::uint8_t>({0, 1, 128, 255, 5, 6}, false), (std::vector<float>{0, 1, 128, 255, 5, 6}));
  EXPECT_EQ(as_texcoords<std::int16_t>({0, 1, -32768, 32767, 5, -6}, false), (std::vector<float>{0, 1, -32768, 32767, 5, -6}));
  EXPECT_EQ(as_texcoords<std::uint16_t>({0, 1, 256, 65535, 5, 6}, false), (std::vector<float>{0, 1, 256, 65535, 5, 6}));
}

TEST(accessor, of_normalized_numbers_has_shares_of_the_largest) {
  EXPECT_EQ(as_texcoords<std::int8_t>({0, 127, -127, -128, 64, -1}, true), (std::vector<float>{0, 1, -1, -1, 64 / 127.F, -1 / 127.F}));
  EXPECT_EQ(as_texcoords<std::uint8_t>({0, 255, 1, 128, 5, 6}, true),
            (std::vector<float>{0, 1, 1 / 255.F, 128 / 255.F, 5 / 255.F, 6 / 255.F}));
  EXPECT_EQ(as_texcoords<std::int16_t>({0, 32767, -32767, -32768, 1, 2}, true),
            (std::vector<float>{0, 1, -1, -1, 1 / 32767.F, 2 / 32767.F}));
  EXPECT_EQ(as_texcoords<std::uint16_t>({0, 65535, 1, 2, 3, 4}, true),
            (std::vector<float>{0, 1, 1 / 65535.F, 2 / 65535.F, 3 / 65535.F, 4 / 65535.F}));
}

TEST(accessor, of_indices_has_one_two_or_four_bytes) {
  const Triangles turned = {{0, 1, 2}};  // numbered as the corners come
  EXPECT_EQ(by_indices<std::uint8_t>({2, 1, 0}), turned);
  EXPECT_EQ(by_indices<std::uint16_t>({2, 1, 0}), turned);
  EXPECT_EQ(by_indices<std::uint32_t>({2, 1, 0}), turned);
  EXPECT_EQ(by_indices<std::uint16_t>({0, 1, 2, 2, 1, 0}), (Triangles{{0, 1, 2}, {2, 1, 0}}));
}

TEST(accessor, may_share_a_view_with_others) {
  File file;
  // Position, two shares, position, …: 16 bytes each, behind 8 bytes of something else.
  std::string bytes = "something";
  bytes.resize(8);
  for (int i = 0; i < 3; ++i)
    bytes += bytes_of<float>({10.F + static_cast<float>(i), static_cast<float>(i * i), -1}) +
             bytes_of<std::uint16_t>({static_cast<std::uint16_t>(i), 65535});
  const int view = file.view(bytes.substr(0, bytes.size()));
  file.json["bufferViews"][0]["byteStride"] = 16;
  const int positions = file.accessor(view, 5126, "VEC3", 3, 8), coordinates = file.accessor(view, 5123, "VEC2", 3, 20);
  file.mesh({{"POSITION", positions}, {"TEXCOORD_0", coordinates}});
  file.node({{"mesh", 0}});
  const Part part = parts_at_rest(model_of(file))[0];
  EXPECT_EQ(part.mesh.vertices, (Vertices{{10, 0, -1}, {11, 1, -1}, {12, 4, -1}}));
  EXPECT_EQ(part.texcoords[0], (std::vector<std::array<float, 2>>{{0, 65535}, {1, 65535}, {2, 65535}}));
}

TEST(accessor, may_end_with_its_view_though_a_stride_would_not) {
  File file;
  const int view = file.view(bytes_of<float>({0, 0, 0, 9, 1, 0, 0, 9, 0, 1, 0}));
  file.json["bufferViews"][0]["byteStride"] = 16;
  file.mesh({{"POSITION", file.accessor(view, 5126, "VEC3", 3)}});
  file.node({{"mesh", 0}});
  EXPECT_EQ(parts_at_rest(model_of(file))[0].mesh.vertices, corner_vertices);
  file.json["accessors"][0]["count"] = 4;
  expect_fault(file.glb(), "accessors[0] ends outside its view");
}

TEST(accessor, may_lie_at_any_byte) {
  File file;
  const int view = file.view("x" + bytes_of(corner_positions));
  file.mesh({{"POSITION", file.accessor(view, 5126, "VEC3", 3, 1)}});
  file.node({{"mesh", 0}});
  EXPECT_EQ(parts_at_rest(model_of(file))[0].mesh.vertices, corner_vertices);
}

TEST(accessor, that_is_sparse_has_other_values_in_places) {
  EXPECT_EQ(parts_at_rest(model_of(with_sparse(true)))[0].mesh.vertices, (Vertices{{5, 6, 7}, {1, 0, 0}, {8, 9, 10}}));
  EXPECT_EQ(parts_at_rest(model_of(with_sparse(false)))[0].mesh.vertices, (Vertices{{5, 6, 7}, {0, 0, 0}, {8, 9, 10}}));
}

TEST(accessor, that_is_sparse_has_indices_of_one_two_or_four_bytes) {
  for (const int component : {5121, 5125}) {
    File file = with_sparse(true);
    const int view = file.view(component == 5121 ? bytes_of<std::uint8_t>({0, 2}) : bytes_of<std::uint32_t>({0, 2}));
    file.json["accessors"][0]["sparse"]["indices"] = {{"bufferView", view}, {"componentType", component}};
    EXPECT_EQ(parts_at_rest(model_of(file))[0].mesh.vertices, (Vertices{{5, 6, 7}, {1, 0, 0}, {8, 9, 10}}));
  }
}

TEST(accessor, that_is_sparse_with_indices_that_do_not_rise_or_are_none_is_refused) {
  const auto with = [](std::uint16_t first, std::uint16_t second) {
    File file = with_sparse(true);
    file.json["accessors"][0]["sparse"]["indices"] = {{"bufferView", file.view(bytes_of<std::uint16_t>({first, second}))},
                                                      {"componentType", 5123}};
    return file.glb();
  };
  expect_fault(with(0, 3), "accessors[0].sparse.indices has an index that is none of an element\n  got 3 as number 1");
  expect_fault(with(65535, 2), "accessors[0].sparse.indices has an index that is none");
  expect_fault(with(1, 1), "accessors[0].sparse.indices do not rise\n  got 1 behind 1");
  expect_fault(with(2, 0), "accessors[0].sparse.indices do not rise");
  (void)read("m", with(1, 2), {});
}

TEST(accessor, without_a_view_is_of_zeros) {
  File file = triangle_file();
  file.primitive(0)["attributes"]["TEXCOORD_0"] = file.add("accessors", {{"componentType", 5126}, {"type", "VEC2"}, {"count", 3}});
  EXPECT_EQ(texcoords_of(file), std::vector<float>(6, 0));
}

TEST(accessor, that_many_primitives_use_is_there_once) {
  File file = triangle_file();
  const Document primitive = file.primitive(0);
  for (int i = 0; i < 5; ++i) file.json["meshes"][0]["primitives"].push_back(primitive);
  const Model model = model_of(file);
  ASSERT_EQ(model.meshes[0].primitives.size(), 6U);
  for (const auto& one : model.meshes[0].primitives) EXPECT_EQ(one.positions, model.meshes[0].primitives[0].positions);
}

TEST(accessor, that_claims_more_than_memory_is_refused_before_any_is_taken) {
  for (const double count : {4e9, 1e15, 9007199254740992.0, 23e6}) {
    File file = triangle_file();
    file.json["accessors"][0].erase("bufferView");
    file.json["accessors"][0]["count"] = static_cast<std::uint64_t>(count);
    const std::string message = message_of(file.glb(), ErrorKind::limit);
    EXPECT_TRUE(test::has(message, count < 2147483648.0 ? "m: error: accessors[0] has too many elements" : "too many vertices")) << message;
  }
}

TEST(accessor, that_overlaps_others_counts_each_time) {
  // Bytes that are there once, as coordinates of a thousand primitives: 8 million shorts become 32 MB each time.
  File file;
  const std::size_t vertices = 1'000'000;
  const int view = file.view(std::string(4 * vertices, '\0')), positions = file.view(std::string(3 * vertices, '\0'));
  file.accessor(positions, 5121, "VEC3", vertices);
  Document primitives = Document::array();
  for (int i = 0; i < 1000; ++i)
    primitives.push_back({{"attributes", {{"POSITION", 0}, {"TEXCOORD_0", file.accessor(view, 5123, "VEC2", vertices)}}}});
  file.add("meshes", {{"primitives", primitives}});
  EXPECT_TRUE(test::has(message_of(file.glb(), ErrorKind::limit), "has too many elements"));
}
