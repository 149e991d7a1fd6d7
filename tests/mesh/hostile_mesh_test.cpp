// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Files cut short, changed or far too large: an error or a sound mesh, and no memory for what is not there.
#include <cstdlib>
#include <memory>

#include "base/limits.h"
#include "mesh/numbers.h"
#include "mesh_files.h"

using namespace tofray;
using namespace tofray::mesh_test;

namespace {

struct Sample {
  Format format;
  std::string bytes;
  std::size_t needed;  ///< bytes without which it is no mesh
};

std::vector<Sample> samples() {
  std::vector<Sample> all;
  const auto add = [&](Format format, const std::string& bytes, std::size_t needed) { all.push_back({format, bytes, needed}); };
  add(Format::obj, corner_obj, corner_obj.find("f 1 3 2") + 7);
  add(Format::obj, full_obj, full_obj.find("f 1/1/1") + 15);
  const std::string text = plain_ply(PlyWriter::Encoding::text), text_of_stl = text_stl();
  add(Format::ply, text, text.size() - 1);
  for (const auto encoding : {PlyWriter::Encoding::little, PlyWriter::Encoding::big})
    for (const std::string& file : {plain_ply(encoding), full_ply(encoding)}) add(Format::ply, file, file.size());
  add(Format::stl, text_of_stl, text_of_stl.find("endsolid") + 3);
  add(Format::stl, binary_stl(), binary_stl().size());
  add(Format::stl, binary_stl("solid"), binary_stl().size());
  return all;
}

std::string message_of(Format format, std::string_view bytes, ErrorKind kind) {
  const Error error = out_test::error_of([&] { (void)mesh::parse(format, bytes, "m"); });
  EXPECT_EQ(error.kind(), kind) << error.what();
  return error.what();
}

/// A file that is long, but of which memory has only what is written: the beginning.
struct LongFile {
  std::unique_ptr<char, decltype(&std::free)> memory;
  std::size_t size;
  LongFile(const std::string& beginning, std::size_t zeros)
      : memory(static_cast<char*>(std::calloc(beginning.size() + zeros, 1)), std::free), size(beginning.size() + zeros) {
    if (memory) std::memcpy(memory.get(), beginning.data(), beginning.size());
  }
  [[nodiscard]] std::string_view bytes() const { return {memory.get(), memory ? size : 0}; }
};

}  // namespace

TEST(mesh_file, cut_short_anywhere_is_an_error_or_a_mesh) {
  for (const Sample& sample : samples()) {
    ASSERT_TRUE(is_taken(sample.format, sample.bytes));
    for (std::size_t size = 0; size < sample.bytes.size(); ++size) {
      SCOPED_TRACE(base::printable(sample.bytes.substr(0, 40)) + " … " + std::to_string(size));
      const bool taken = is_taken(sample.format, std::string_view(sample.bytes).substr(0, size));
      if (size < sample.needed) {
        EXPECT_FALSE(taken);
      }
    }
  }
}

TEST(mesh_file, with_any_byte_changed_is_an_error_or_a_mesh) {
  std::size_t taken = 0, refused = 0;
  for (const Sample& sample : samples())
    for (std::size_t at = 0; at < sample.bytes.size(); ++at)
      for (const char byte : {'\0', '\xFF', '\x7F', '\x80', '\n', '\r', ' ', '-', '9', '/', '\\', '#', 'e'}) {
        std::string changed = sample.bytes;
        changed[at] = byte;
        SCOPED_TRACE(at);
        (is_taken(sample.format, changed) ? taken : refused) += 1;
      }
  EXPECT_GT(taken, 5000U);
  EXPECT_GT(refused, 5000U);
}

TEST(mesh_file, with_a_byte_taken_out_or_put_in_is_an_error_or_a_mesh) {
  for (const Sample& sample : samples())
    for (std::size_t at = 0; at < sample.bytes.size(); ++at) {
      SCOPED_TRACE(at);
      std::string changed = sample.bytes;
      (void)is_taken(sample.format, changed.erase(at, 1));
      (void)is_taken(sample.format, changed.insert(at, "\n7"));
    }
}

TEST(mesh_file, with_many_changes_is_an_error_or_a_mesh) {
  out_test::Random random(7);
  const std::vector<Sample> all = samples();
  for (int trial = 0; trial < 20000; ++trial) {
    const Sample& sample = all[random.below(all.size())];
    std::string changed = sample.bytes;
    for (std::size_t changes = 1 + random.below(5); changes > 0; --changes) {
      const std::size_t at = random.below(changed.size()), from = random.below(changed.size()), size = random.below(20);
      if (random.below(2) == 0)
        changed[at] = static_cast<char>(random.next());
      else
        changed.replace(at, random.below(20), changed.substr(from, size));
      if (changed.empty()) changed = "v";
    }
    SCOPED_TRACE(base::printable(changed));
    (void)is_taken(sample.format, changed);
  }
}

TEST(mesh_file, of_another_format_is_an_error) {
  for (const Sample& sample : samples())
    for (const Format format : {Format::obj, Format::ply, Format::stl})
      if (format != sample.format) {
        EXPECT_FALSE(is_taken(format, sample.bytes));
      }
}

TEST(mesh_file, takes_as_many_triangles_as_the_limit_and_no_more) {
  const auto most = static_cast<std::size_t>(base::limit::mesh_triangles.value);
  std::string text = "v 0 0 0\nf";
  for (std::size_t i = 0; i < most + 2; ++i) text += " 1";
  EXPECT_EQ(mesh::parse(Format::obj, text, "m").mesh.triangles.size(), most);
  EXPECT_EQ(message_of(Format::obj, text + " 1", ErrorKind::limit).rfind("m: error: the mesh has more than 20000000 triangles", 0), 0U);
}

TEST(mesh_file, that_announces_more_than_the_limits_is_refused_before_it_is_read) {
  const std::string many = "20000001";
  const std::string vertices =
      "ply\nformat binary_little_endian 1.0\nelement vertex " + many + "\nproperty char x\nproperty char y\nproperty char z\nend_header\n";
  EXPECT_TRUE(
      test::has(message_of(Format::ply, LongFile(vertices, 3 * 20'000'001).bytes(), ErrorKind::limit), "more than 20000000 vertices"));
  const std::string faces =
      "ply\nformat binary_little_endian 1.0\nelement vertex 0\nproperty char x\nproperty char y\nproperty char z\nelement face " + many +
      "\nproperty list char char vertex_index\nend_header\n";
  EXPECT_TRUE(
      test::has(message_of(Format::ply, LongFile(faces, 4 * 20'000'001).bytes(), ErrorKind::limit), "more than 20000000 triangles"));
  std::string stl(80, ' ');
  stl += number_bytes(std::uint32_t{20'000'001}, false);
  EXPECT_TRUE(test::has(message_of(Format::stl, LongFile(stl, 50 * std::size_t{20'000'001}).bytes(), ErrorKind::limit),
                        "more than 20000000 triangles"));
}

TEST(mesh_file, that_announces_more_than_it_has_is_refused_before_memory_is_taken) {
  for (const char* count :
       {"1000000", "20000000", "2147483648", "4294967295", "9223372036854775807", "9223372036854775808", "18446744073709551615"})
    for (const char* encoding : {"ascii", "binary_little_endian", "binary_big_endian"}) {
      const std::string begin = std::string("ply\nformat ") + encoding + " 1.0\nelement vertex ",
                        xyz = "\nproperty double x\nproperty double y\nproperty double z\n";
      EXPECT_TRUE(test::has(message_of(Format::ply, begin + count + xyz + "end_header\n0 0 0", ErrorKind::bad_input),
                            "too short for element \"vertex\""));
      EXPECT_TRUE(
          test::has(message_of(Format::ply,
                               begin + "0" + xyz + "element face " + count + "\nproperty list char char vertex_index\nend_header\n3 0 0 0",
                               ErrorKind::bad_input),
                    "too short for element \"face\""));
      EXPECT_TRUE(test::has(
          message_of(Format::ply, begin + "0" + xyz + "element other " + count + "\nproperty list char char a\nend_header\n3 0 0 0",
                     ErrorKind::bad_input),
          "too short for element \"other\""));
    }
}

TEST(mesh_file, with_a_header_beyond_measure_is_refused) {
  const std::string comments = "ply\nformat ascii 1.0\n" + replaced(std::string(10'000, '#'), "#", "comment\n");
  EXPECT_TRUE(test::has(message_of(Format::ply, comments, ErrorKind::limit), "the header is longer than 65536 bytes"));
  EXPECT_TRUE(
      test::has(message_of(Format::ply, "ply\ncomment " + std::string(1'000'000, 'x'), ErrorKind::limit), "longer than 65536 bytes"));
}

TEST(mesh_file, is_of_the_format_that_its_suffix_says) {
  EXPECT_EQ(mesh::format_of("a.obj", base::whole("a.obj")), Format::obj);
  EXPECT_EQ(mesh::format_of("folder.stl/b.c.PLY", base::whole("folder.stl/b.c.PLY")), Format::ply);
  EXPECT_EQ(mesh::format_of("/x/.Stl", base::whole("/x/.Stl")), Format::stl);
  const auto message = [](const std::string& path) {
    const Error error = out_test::error_of([&] { (void)mesh::format_of(path, base::whole(path)); });
    EXPECT_EQ(error.kind(), ErrorKind::bad_input);
    return std::string(error.what());
  };
  EXPECT_EQ(message("a.fbx"),
            "a.fbx: error: \"a.fbx\" is no mesh that can be read\n  got an FBX file (.fbx), expected .obj, .ply, .stl, .glb or .gltf; "
            "Blender imports it and exports glTF (.glb)");
  EXPECT_EQ(message("a.doc"),
            "a.doc: error: \"a.doc\" is no mesh that can be read\n  got the suffix \".doc\", expected .obj, .ply, .stl, .glb or .gltf");
  EXPECT_EQ(
      message("a.ply/mesh"),
      "a.ply/mesh: error: \"mesh\" is no mesh that can be read\n  got a name without suffix, expected .obj, .ply, .stl, .glb or .gltf");
  for (const char* path : {"", ".", "/", "obj", "a.obj ", "a.objx", "a.\x1b[1m"})
    EXPECT_TRUE(test::has(message(path), "expected .obj, .ply, .stl, .glb or .gltf"));
}

TEST(mesh_numbers, become_the_nearest_float_or_infinity) {
  constexpr float most = std::numeric_limits<float>::max();
  EXPECT_EQ(mesh::to_float(0.1), 0.1F);
  EXPECT_EQ(mesh::to_float(static_cast<double>(most)), most);
  EXPECT_EQ(mesh::to_float(-static_cast<double>(most)), -most);
  EXPECT_EQ(mesh::to_float(3.5e38), HUGE_VALF);
  EXPECT_EQ(mesh::to_float(-1e300), -HUGE_VALF);
  EXPECT_TRUE(std::isnan(mesh::to_float(std::nan(""))));
}
