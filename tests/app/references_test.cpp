// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// What a scene's meshes name: other files, which lie beside them or below, and are of a size that somebody meant.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "attack.h"
#include "image/image_files.h"
#include "load/load.h"

using namespace tofray;
using namespace tofray::test;

namespace {

constexpr const char* corner_obj = "v 0 0 1\nv 1 0 1\nv 0 1 1\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n";

std::string quoted(const std::string& text) { return nlohmann::json(text).dump(); }

/// Three corners and their texture coordinates.
std::string corner_bytes() {
  const float numbers[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1};
  return {reinterpret_cast<const char*>(numbers), sizeof numbers};
}
std::string corner_gltf(const std::string& buffer, const std::string& image) {
  return R"({"asset": {"version": "2.0"}, "buffers": [{"byteLength": 60, "uri": )" + quoted(buffer) + R"(}],
"bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 24}],
"accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]},
{"bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC2"}],
"images": [{"uri": )" +
         quoted(image) + R"(}], "textures": [{"source": 0}],
"materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
"meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "material": 0}]}], "nodes": [{"mesh": 0}]})";
}

/// One place where a file names another, and what lies there that nobody may read.
struct Naming {
  const char* what;
  std::string file;                                      ///< the name of a good one
  std::string good;                                      ///< its bytes
  std::string scene;                                     ///< the scene's mesh
  std::function<std::string(const std::string&)> namer;  ///< the file `namer_file` that names it
  std::string namer_file;
};

std::vector<Naming> all_namings() {
  const std::string png = image_test::hand_png(1, 1, 8, image_test::rgb, std::string("\0\x80\x80\x80", 4));
  const auto scene = [](const std::string& mesh) { return "objects: [{mesh: {file: " + quoted(mesh) + "}}]\n"; };
  return {{"the mesh of a scene", "good.obj", corner_obj, "",
           [](const std::string& name) { return "objects: [{mesh: {file: " + quoted(name) + ", reflectivity: 0.5}}]\n"; }, "scene.yaml"},
          {"a buffer of glTF", "good.bin", corner_bytes(), scene("a.gltf"),
           [](const std::string& name) { return corner_gltf(name, "own.png"); }, "a.gltf"},
          {"an image of glTF", "good.png", png, scene("a.gltf"), [](const std::string& name) { return corner_gltf("own.bin", name); },
           "a.gltf"},
          {"mtllib", "good.mtl", "newmtl a\nKd 1 1 1\n", scene("a.obj"),
           [](const std::string& name) { return "mtllib " + name + "\nusemtl a\n" + corner_obj; }, "a.obj"},
          {"map_Kd", "good.png", png, scene("b.obj"), [](const std::string& name) { return "newmtl a\nmap_Kd " + name + "\n"; }, "b.mtl"}};
}

class references : public testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(in() / "below");
    fs::create_directories(top_.path() / "inside-too");
    ::setenv("HOME", top_.path().c_str(), 1);
    write(in() / "own.png", all_namings()[2].good), write(in() / "own.bin", corner_bytes());
    write(in() / "b.obj", std::string("mtllib b.mtl\nusemtl a\n") + corner_obj);
    fs::create_directory_symlink(top_.path(), in() / "up");
  }
  void TearDown() override { ::setenv("HOME", home_.c_str(), 1); }
  [[nodiscard]] fs::path in() const { return top_.path() / "inside"; }

  /// Good files where nobody may read them, and what is no file.
  void lay_out(const Naming& one) const {
    write(in() / one.file, one.good);
    const std::string out = outside(one);
    write(top_.path() / out, one.good), write(top_.path() / "inside-too" / out, one.good);
    for (const char* const link : {"link", "pipe"}) fs::remove(in() / (link + suffix(one)));
    fs::create_symlink(top_.path() / out, in() / ("link" + suffix(one)));
    ASSERT_EQ(::mkfifo((in() / ("pipe" + suffix(one))).c_str(), 0600), 0);
    fs::create_directories(in() / ("folder" + suffix(one)));
  }
  static std::string suffix(const Naming& one) { return fs::path(one.file).extension().string(); }
  static std::string outside(const Naming& one) { return "outside" + suffix(one); }

  [[nodiscard]] std::vector<std::string> escapes(const Naming& one) const {
    const std::string out = outside(one), end = suffix(one);
    std::vector<std::string> names = {"../" + out,
                                      "below/../../" + out,
                                      "below/./../../" + out,
                                      "./../" + out,
                                      "link" + end,
                                      "up/" + out,
                                      "up/inside/" + one.file,
                                      (top_.path() / out).string(),
                                      (in() / one.file).string(),
                                      "../inside-too/" + out,
                                      "pipe" + end,
                                      "folder" + end,
                                      "/dev/zero" + end,
                                      one.file + "/",
                                      std::string("good\0", 5) + end,
                                      one.file + std::string(1, '\0'),
                                      std::string(1, '\0') + one.file,
                                      "..",
                                      ".",
                                      "below",
                                      "/",
                                      "//",
                                      "/dev/zero",
                                      "/dev/stdin",
                                      "/etc/passwd",
                                      "/proc/self/environ"};
    for (const char* const before :
         {"file:",     "file://", "file:///", "http://", "https://", "ftp://",           "//server/",       "\\\\server\\",
          "C:\\",      "~/",      "~root/",   "$HOME/",  "${HOME}/", "`pwd`/",           "$(pwd)/",         "%2e%2e/",
          "%2e%2e%2f", "..%2f",   "%2E./",    "....//",  "..\\",     "/proc/self/root/", "/proc/self/cwd/", "../inside/../"})
      for (const std::string& file : {out, "../" + out}) names.push_back(before + file);
    return names;
  }
  void write_scene(const Naming& one, const std::string& name) const {
    if (!one.scene.empty()) write(in() / "scene.yaml", one.scene);
    write(in() / one.namer_file, one.namer(name));
  }
  /// What is wrong, or nothing.
  [[nodiscard]] std::string loaded(const Naming& one, const std::string& name) const {
    write_scene(one, name);
    try {
      // What OBJ and MTL files name and is not there is left out, and told.
      for (const Object& object : load::load_scene((in() / "scene.yaml").string(), {}).objects)
        for (const std::string& notice : std::get<Mesh>(object.shape).notices)
          if (has(notice, "cannot be read and is left out: ") || has(notice, "there is no \"")) return notice;
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }

  Folder top_;
  const std::string home_ = std::getenv("HOME") == nullptr ? "" : std::getenv("HOME");
};

}  // namespace

TEST_F(references, to_files_beside_and_below_are_read) {
  for (const Naming& one : all_namings()) {
    lay_out(one);
    write(in() / "below" / one.file, one.good);
    EXPECT_EQ(loaded(one, one.file), "") << one.what;
    EXPECT_EQ(loaded(one, "below/" + one.file), "") << one.what;
    EXPECT_EQ(loaded(one, "./below/./" + one.file), "") << one.what;
  }
}

// Five places, some seventy names each: nothing of it is loaded, though good files lie where they lead; of OBJ and MTL files a file of the
// same name in the folder may be, and is told.
TEST_F(references, that_lead_elsewhere_are_refused) {
  for (const Naming& one : all_namings()) {
    lay_out(one);
    const std::vector<std::string> names = escapes(one);
    EXPECT_GE(names.size(), 70U);
    for (const std::string& name : names) {
      const std::string said = loaded(one, name);
      const bool may_be_left_out = one.what == std::string("mtllib") || one.what == std::string("map_Kd");
      EXPECT_TRUE(has(said, "error: ") || (may_be_left_out && (has(said, "is left out: ") || has(said, "there is no \""))))
          << one.what << ": " << name << " -> " << said;
      EXPECT_TRUE(is_printable(said)) << one.what << ": " << name;
    }
  }
}

// The kernel's word for it: strace writes which file each descriptor is of.
TEST_F(references, that_lead_elsewhere_open_nothing_there) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers do not run under strace";
#endif
  const Folder logs;
  const auto opened = [&](const std::string& scene) {
    const std::string log = (logs / "log").string();
    (void)test::run({}, [&] {
      in_folder(in())();
      ::execlp("strace", "strace", "-f", "-y", "-qqq", "-o", log.c_str(), "-e", "trace=open,openat,openat2,connect", TOFRAY_TOOL, "check",
               scene.c_str(), nullptr);
      ::_exit(127);
    });
    return content(log);
  };
  const Naming first = all_namings()[0];
  lay_out(first);
  write_scene(first, first.file);
  if (!has(opened("scene.yaml"), "<" + (fs::canonical(in()) / first.file).string() + ">"))
    GTEST_SKIP() << "no strace here, or it may not trace";
  const std::string top = fs::canonical(top_.path()).string(), within = top + "/inside/";
  for (const Naming& one : all_namings()) {
    lay_out(one);
    for (const std::string& name :
         {"../" + outside(one), (top_.path() / outside(one)).string(), "link" + suffix(one), "up/" + outside(one), "%2e%2e/" + outside(one),
          "file://" + (top_.path() / outside(one)).string(), "~/" + outside(one), std::string("/etc/passwd"), std::string("/dev/zero"),
          "http://localhost/" + outside(one), "pipe" + suffix(one), "folder" + suffix(one), std::string("/proc/self/environ"),
          "\\\\server\\" + outside(one), "$HOME/" + outside(one), "`pwd`/../" + outside(one)}) {
      write_scene(one, name);
      const std::string log = opened("scene.yaml");
      EXPECT_TRUE(has(log, within + "scene.yaml>")) << log.substr(0, 2000);
      EXPECT_FALSE(has(log, "connect(")) << one.what << ": " << name;
      for (std::size_t at = log.find("= "); at != std::string::npos; at = log.find("= ", at + 1)) {
        const std::size_t from = log.find('<', at), end = log.find('\n', at);
        if (from >= end) continue;
        const std::string file = log.substr(from + 1, log.find('>', from) - from - 1);
        EXPECT_FALSE(file.starts_with(top + "/outside") || file.starts_with(top + "/inside-too"))
            << one.what << ": " << name << " " << file;
        EXPECT_TRUE(file != "/etc/passwd" && file != "/dev/zero" && !file.ends_with("/environ")) << one.what << ": " << name;
        EXPECT_TRUE(!file.starts_with(top) || file == top || file.starts_with(top + "/inside")) << one.what << ": " << name << " " << file;
      }
    }
  }
}

// A file that says it is large is, or is not; either way it takes no memory.
TEST(oversized_meshes, are_refused_at_the_limit) {
  const Folder folder;
  const auto refused = [&](const std::string& file, int code, const std::string& part) {
    write(folder / "s.yaml", "objects: [{mesh: {file: " + file + ", reflectivity: 0.5}}]\n");
    const Attack result = attack(folder, {"check", "s.yaml"});
    expect_refused(result, code, part);
    EXPECT_LT(result.peak_bytes, most_memory(128L << 20)) << file;
  };
  // 4 GB that a header promises, of which 20 bytes are there.
  write(folder / "claims.glb", std::string("glTF\2\0\0\0\xFF\xFF\xFF\xFF\xEE\xFF\xFF\xFFJSON", 20));
  refused("claims.glb", 2, "claims.glb: error: ");
  // A data URI of 1 GiB, as a file with a hole.
  write(folder / "data.gltf", R"({"asset": {"version": "2.0"}, "buffers": [{"byteLength": 3, "uri": "data:;base64,)");
  fs::resize_file(folder / "data.gltf", (1ULL << 30) + 100);
  refused("data.gltf", 4, "is too long");
  // A scene that somebody packed.
  write(folder / "scene.obj", std::string("\x1F\x8B\x08\0\0\0\0\0\0\3", 10) + std::string(1000, '\xA5'));
  refused("scene.obj", 2, "scene.obj: error: this is no OBJ file, but a compressed file");
  // 2^40 instances need one node below two others again and again: a node has one parent.
  std::string nodes;
  for (int i = 0; i < 40; ++i) nodes += "{\"children\": [" + std::to_string(i + 1) + ", " + std::to_string(i + 1) + "]}, ";
  write(folder / "many.gltf", R"({"asset": {"version": "2.0"}, "nodes": [)" + nodes + "{}]}");
  refused("many.gltf", 2, "many.gltf: error: nodes[");
}
