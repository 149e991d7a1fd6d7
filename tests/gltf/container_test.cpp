// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Files as JSON, as binary, and with their bytes in files beside them.
#include "gltf_files.h"

using namespace tofray;
using namespace tofray::gltf_test;

namespace {

void expect_triangle(const Model& model) {
  const auto parts = parts_at_rest(model);
  ASSERT_EQ(parts.size(), 1U);
  EXPECT_EQ(parts[0].mesh.vertices, corner_vertices);
  EXPECT_EQ(parts[0].mesh.triangles, (Triangles{{0, 1, 2}}));
}

gltf::Resources one_file(const std::string& path, const std::string& bytes) {
  return [=](const std::string& asked, std::size_t) {
    EXPECT_EQ(asked, path);
    return bytes;
  };
}

std::string message_of_uri(const std::string& uri, ErrorKind kind = ErrorKind::bad_input) {
  return message_of(triangle_file().text_beside(uri), kind, [](const std::string&, std::size_t) -> std::string {
    ADD_FAILURE() << "a file was asked for";
    return {};
  });
}

}  // namespace

TEST(gltf_file, is_the_same_as_json_as_binary_and_with_a_file_beside_it) {
  const File file = triangle_file();
  expect_triangle(read("m", file.text(), {}));
  expect_triangle(read("m", file.glb(), {}));
  expect_triangle(read("m", file.text_beside("corner.bin"), one_file("corner.bin", file.binary)));
  EXPECT_TRUE(read("m", file.glb(), {}).notices.empty());
}

TEST(gltf_file, may_begin_with_a_byte_order_mark) { expect_triangle(read("m", "\xEF\xBB\xBF" + triangle_file().text(), {})); }

TEST(gltf_file, names_files_beside_it_with_percent_signs) {
  const File file = triangle_file();
  expect_triangle(read("m", file.text_beside("a%20b/%C3%A4.bin"), one_file("a b/\xC3\xA4.bin", file.binary)));
  expect_triangle(read("m", file.text_beside("./a.b..c/d"), one_file("./a.b..c/d", file.binary)));
}

TEST(gltf_file, reads_nothing_that_does_not_lie_beside_it) {
  for (const char* uri : {"http://a.b/c", "https://a.b/c", "file:///etc/passwd", "FTP:x", "c:\\a.bin", "urn:a"})
    EXPECT_TRUE(test::has(message_of_uri(uri), "m: error: buffers[0].uri has the scheme \"")) << uri;
  for (const char* uri : {"/etc/passwd", "//host/a", "%2Fetc/passwd"})
    EXPECT_TRUE(test::has(message_of_uri(uri), "buffers[0].uri is an absolute path")) << uri;
  for (const char* uri : {"..", "../a", "a/../b", "a/..", "%2e%2E/a", "a/%2e./b"})
    EXPECT_TRUE(test::has(message_of_uri(uri), "buffers[0].uri leads out of its folder")) << uri;
  EXPECT_TRUE(test::has(message_of_uri("a\\b"), "has a backslash"));
  EXPECT_TRUE(test::has(message_of_uri("a%00b"), "has a byte 0"));
  for (const char* uri : {"%", "%4", "a%4", "%4G", "%g4", "a%%20"})
    EXPECT_TRUE(test::has(message_of_uri(uri), "a percent sign without two hexadecimal digits")) << uri;
  EXPECT_TRUE(test::has(message_of_uri(std::string(1001, 'a'), ErrorKind::limit), "is too long"));
  File empty = triangle_file();
  empty.json["buffers"] = {{{"byteLength", 36}, {"uri", ""}}};
  EXPECT_TRUE(test::has(message_of(empty.json.dump()), "buffers[0].uri is empty"));
  EXPECT_TRUE(test::has(message_of(triangle_file().text_beside("a.bin")), "buffers[0].uri is a file of its own"));
}

TEST(gltf_file, hands_on_what_the_reader_of_other_files_says) {
  const auto missing = [](const std::string& path, std::size_t) -> std::string { throw Error(ErrorKind::io, path + ": error: gone"); };
  EXPECT_EQ(message_of(triangle_file().text_beside("a.bin"), ErrorKind::io, missing), "a.bin: error: gone");
}

TEST(gltf_file, has_data_uris_of_any_type_with_or_without_padding) {
  const File file = triangle_file();
  std::string digits = base64(file.binary);
  for (const char* kind : {"data:application/gltf-buffer;base64,", "data:;base64,", "data:a/b;c=d;base64,"})
    expect_triangle(read("m", file.text_beside(kind + digits), {}));
  File odd = file;
  odd.binary += "ab";  // 38 bytes: one '='
  digits = base64(odd.binary);
  ASSERT_TRUE(digits.ends_with("=") && !digits.ends_with("=="));
  expect_triangle(read("m", odd.text_beside("data:;base64," + digits), {}));
  digits.pop_back();
  expect_triangle(read("m", odd.text_beside("data:;base64," + digits), {}));
}

TEST(gltf_file, with_a_broken_data_uri_is_refused) {
  const File file = triangle_file();
  const std::string digits = base64(file.binary);
  for (const std::string& uri :
       std::vector<std::string>{"data:" + digits, "data:,abc", "data:", "data:;base64", "data:;base64;x," + digits})
    EXPECT_TRUE(test::has(message_of_uri(uri), "buffers[0].uri is a data URI without base64")) << uri;
  for (const std::string& wrong :
       std::vector<std::string>{digits + "A", digits + "!", "\xC3\xA4" + digits, digits + "===", " " + digits, "=" + digits, digits + "-_"})
    EXPECT_TRUE(test::has(message_of_uri("data:;base64," + wrong), "buffers[0].uri has broken base64")) << wrong;
  EXPECT_TRUE(test::has(message_of_uri("data:;base64," + digits.substr(4)), "buffers[0] is cut short"));
}

TEST(gltf_file, of_bytes_that_json_has_is_told_by_its_first_four) {
  EXPECT_TRUE(test::has(message_of("glTX"), "this is not JSON"));
  EXPECT_TRUE(test::has(message_of(""), "m:1:1: error: this is not JSON"));
  EXPECT_TRUE(test::has(message_of("[]"), "m: error: this is no glTF file"));
  EXPECT_TRUE(test::has(message_of("{}"), "m: error: asset is missing"));
}

TEST(glb, passes_chunks_that_it_does_not_know) {
  const File file = triangle_file();
  const std::string json = chunk("JSON", file.with_buffer("").dump()), bytes = chunk(std::string("BIN\0", 4), file.binary);
  expect_triangle(read("m", glb_of(json + bytes + chunk("abcd", "123")), {}));
  expect_triangle(read("m", glb_of(json + chunk("abcd", "") + bytes), {}));
}

TEST(glb, with_chunks_in_disorder_is_refused) {
  const File file = triangle_file();
  const std::string json = chunk("JSON", file.with_buffer("").dump()), bytes = chunk(std::string("BIN\0", 4), file.binary);
  expect_fault(glb_of(bytes + json), "the first chunk is not JSON");
  expect_fault(glb_of(""), "the first chunk is not JSON");
  expect_fault(glb_of(chunk("json", "{}")), "the first chunk is not JSON");
  expect_fault(glb_of(json + json), "there are two chunks of JSON");
  expect_fault(glb_of(json + bytes + bytes), "there are two binary chunks");
  expect_fault(glb_of(json), "bufferViews[0] has no bytes");
  expect_fault(glb_of(json + chunk(std::string("BIN\0", 4), file.binary.substr(1))), "buffers[0] is cut short");
  expect_fault(glb_of(chunk("JSON", "{")), "m:1:2: error: this is not JSON");
}

TEST(glb, of_other_versions_and_lengths_is_refused) {
  const std::string good = triangle_file().glb();
  for (const std::uint32_t version : {0U, 1U, 3U, 0xFFFFFFFFU})
    expect_fault("glTF" + word(version) + good.substr(8), "this is binary glTF of version " + std::to_string(version));
  expect_fault(good + "x", "1 bytes are left over behind the end");
  expect_fault("glTF" + word(2) + word(12) + good.substr(12), "bytes are left over");
  expect_fault("glTF" + word(2) + word(0xFFFFFFFF) + good.substr(12), "the file is cut short");
  for (const std::uint32_t length : {0xFFFFFFFFU, 0x80000000U, 10000U})
    expect_fault(good.substr(0, 12) + word(length) + good.substr(16), "the file is cut short");
}

TEST(glb, cut_short_anywhere_is_refused) {
  const std::string good = triangle_file().glb();
  for (std::size_t size = 0; size < good.size(); ++size) {
    SCOPED_TRACE(size);
    expect_fault(good.substr(0, size), size < 4 ? "this is not JSON" : "the file is cut short");
    // A binary file that is cut short, where its header says so.
    if (size > 12) expect_fault("glTF" + word(2) + word(static_cast<std::uint32_t>(size)) + good.substr(12, size - 12), "m");
  }
}
