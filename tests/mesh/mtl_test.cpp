// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Materials of OBJ files.
#include "mesh/mtl.h"

#include "mesh_files.h"

using namespace tofray;
using namespace tofray::mesh_test;

namespace {

using mesh::Mtl;
using mesh::MtlMaterial;
using Names = std::vector<std::string>;

Mtl mtl(const std::string& text, std::size_t most = 100) { return mesh::parse_mtl(text, "m.mtl", most); }
MtlMaterial one(const std::string& statements) { return mtl("newmtl a\n" + statements).materials.at(0); }

std::string message_of(const std::string& text, ErrorKind kind = ErrorKind::bad_input, std::size_t most = 100) {
  const Error error = out_test::error_of([&] { (void)mtl(text, most); });
  EXPECT_EQ(error.kind(), kind) << error.what();
  return error.what();
}

/// Whether bytes give materials, which then are sound; else an error that may be shown and names the file.
bool gives_materials(const std::string& bytes) {
  const auto is_share = [](double a) { return a >= 0 && a <= 1; };
  try {
    const Mtl read = mesh::parse_mtl(bytes, "hostile", 100);
    EXPECT_LE(read.left_out.size(), 20U);
    for (const MtlMaterial& one : read.materials) {
      EXPECT_TRUE(is_share(one.nir_reflectivity.value_or(0)));
      for (const double a : one.color.value_or(std::array<double, 3>{})) EXPECT_TRUE(is_share(a));
      if (one.picture) {
        EXPECT_FALSE(one.picture->reference.file.empty());
        for (const double a : {one.picture->scale[0], one.picture->scale[1], one.picture->offset[0], one.picture->offset[1]})
          EXPECT_TRUE(std::abs(a) <= 1e6);
      }
    }
    return true;
  } catch (const Error& error) {
    test::expect_told(error, "hostile");
    return false;
  }
}

const std::string full_mtl =
    "# made by hand\nnewmtl red paint\nKd 0.5 0.25 0.125\nKs 1 1 1\n#!nir_reflectivity 0.6\nnewmtl wood\n\tKd 0.5\n\tmap_Kd -s 2 3 1 -o "
    "0.5 "
    "-clamp on side\\wood grain.png\nillum 2\n";

}  // namespace

TEST(mtl, says_colour_reflectivity_and_picture) {
  const Mtl read = mtl(full_mtl);
  ASSERT_EQ(read.materials.size(), 2U);
  EXPECT_EQ(read.materials[0].name, "red paint");
  EXPECT_EQ(read.materials[0].color, (std::array<double, 3>{0.5, 0.25, 0.125}));
  EXPECT_EQ(read.materials[0].nir_reflectivity, 0.6);
  EXPECT_FALSE(read.materials[0].picture);
  EXPECT_EQ(read.materials[1].name, "wood");
  EXPECT_EQ(read.materials[1].color, (std::array<double, 3>{0.5, 0.5, 0.5}));
  EXPECT_FALSE(read.materials[1].nir_reflectivity);
  const mesh::MtlPicture& picture = read.materials[1].picture.value();
  EXPECT_EQ(picture.reference.file, "side/wood grain.png");
  EXPECT_EQ(base::to_string(picture.reference.place), "m.mtl:8:35");
  EXPECT_EQ(picture.scale, (std::array<double, 2>{2, 3}));
  EXPECT_EQ(picture.offset, (std::array<double, 2>{0.5, 0}));
  EXPECT_TRUE(picture.clamp);
  EXPECT_EQ(read.left_out, (Names{"Ks", "illum"}));
}

TEST(mtl, without_a_statement_says_nothing_of_it) {
  const MtlMaterial plain = one("");
  EXPECT_FALSE(plain.color || plain.picture || plain.nir_reflectivity);
  EXPECT_TRUE(mtl("").materials.empty());
  EXPECT_TRUE(mtl("# nothing\n\n").materials.empty());
}

TEST(mtl, keeps_the_last_of_statements_that_come_twice) {
  const MtlMaterial last = one("Kd 1 1 1\nKd 0 0.5 1\nmap_Kd -s 2 a.png\nmap_Kd b.png\n#!nir_reflectivity 0.1\n#!nir_reflectivity 0.2\n");
  EXPECT_EQ(last.color, (std::array<double, 3>{0, 0.5, 1}));
  EXPECT_EQ(last.picture->reference.file, "b.png");
  EXPECT_EQ(last.picture->scale, (std::array<double, 2>{1, 1}));
  EXPECT_EQ(last.nir_reflectivity, 0.2);
  EXPECT_EQ(mtl("newmtl a\nKd 0\nnewmtl a\nKd 1\n").materials.size(), 2U);
}

TEST(mtl, has_its_own_statement_in_a_comment) {
  for (const char* const line : {"#!nir_reflectivity 0.5", " \t#!nir_reflectivity 0.5 # measured", "#!nir_reflectivity\\\n 5e-1"})
    EXPECT_EQ(one(line).nir_reflectivity, 0.5) << line;
  for (const char* const line : {"# !nir_reflectivity 0.5", "# nir_reflectivity 0.5", "##!nir_reflectivity 0.5", "#!",
                                 "#!/usr/bin/env python3", "Kd 1 #!nir_reflectivity 0.5", "#! nir_reflectivity 0.5"})
    EXPECT_FALSE(one(line).nir_reflectivity) << line;
}

TEST(mtl, takes_the_options_of_a_picture_in_any_order_and_number) {
  const auto picture = [](const std::string& text) { return one("map_Kd " + text).picture.value(); };
  EXPECT_EQ(picture("-s 2 a.png").scale, (std::array<double, 2>{2, 1}));
  EXPECT_EQ(picture("-s 2 -3 a.png").scale, (std::array<double, 2>{2, -3}));
  EXPECT_EQ(picture("-s 2 3 4 5.png").reference.file, "5.png");
  EXPECT_EQ(picture("-clamp off -o 0.1 0.2 0.3 -s 4 4 4 a b.png").reference.file, "a b.png");
  EXPECT_EQ(picture("-clamp off -o 0.1 0.2 0.3 -s 4 4 4 a b.png").offset, (std::array<double, 2>{0.1, 0.2}));
  EXPECT_FALSE(picture("-clamp on -clamp off a.png").clamp);
  EXPECT_EQ(picture("./-1.png").reference.file, "./-1.png");
}

TEST(mtl, tells_what_it_leaves_out_once) {
  EXPECT_EQ(mtl("newmtl a\nNs 1\nd 0.5\nmap_Kd -mm 0 1 -bm 2 -blendu on -cc on -imfchan r -boost 2 -texres 9 -t 1 1 1 -type sphere "
                "a.png\nPr 0.5\nnewmtl b\nNs 2\nmap_Bump -bm 1 x.png\n")
                .left_out,
            (Names{"Ns", "d", "-mm of map_Kd", "-bm of map_Kd", "-blendu of map_Kd", "-cc of map_Kd", "-imfchan of map_Kd",
                   "-boost of map_Kd", "-texres of map_Kd", "-t of map_Kd", "-type of map_Kd", "Pr", "map_Bump"}));
  std::string many = "newmtl a\n";
  for (int i = 0; i < 1000; ++i) many += "x" + std::to_string(i) + "\x1b[1m" + std::string(100, 'y') + "\n";
  const Mtl read = mtl(many);
  EXPECT_EQ(read.left_out.size(), 20U);
  EXPECT_TRUE(read.left_out[0].starts_with("x0\\x1b[1myyy")) << read.left_out[0];
  EXPECT_LT(read.left_out[0].size(), 100U);
}

TEST(mtl, has_as_many_materials_as_the_limit_and_no_more) {
  EXPECT_EQ(mtl("newmtl a\nnewmtl b\n", 2).materials.size(), 2U);
  EXPECT_TRUE(
      test::has(message_of("newmtl a\nnewmtl b\n newmtl c\n", ErrorKind::limit, 2), "m.mtl:3:2: error: there are more than 2 materials"));
  EXPECT_TRUE(test::has(message_of("newmtl a\n", ErrorKind::limit, 0), "m.mtl:1:1: error: there are more than 0 materials"));
}

TEST(mtl, with_faults_says_where_and_what) {
  const std::vector<Fault> faults = {
      {"Kd 1 1 1",
       "m.mtl:1:1: error: a statement stands before the first newmtl\n  expected an MTL file, whose materials begin with newmtl"},
      {"\n illum 2", "m.mtl:2:2: error: a statement stands before the first newmtl"},
      {"#!nir_reflectivity 0.5", "m.mtl:1:1: error: a statement stands before the first newmtl"},
      {std::string("\x89PNG\r\n\x1A\n\0\0", 10), "m.mtl:1:1: error: a statement stands before the first newmtl"},
      {"v 0 0 0", "before the first newmtl"},
      {"newmtl a\nKd", "m.mtl:2:3: error: a colour is missing"},
      {"newmtl a\nKd # 1 1 1", "m.mtl:2:4: error: a colour is missing"},
      {"newmtl a\nKd 1 1", "m.mtl:2:7: error: a number is missing\n  the line ends here"},
      {"newmtl a\nKd 1 1 1 1", "m.mtl:2:1: error: the line goes on where it should end\n  got \"1\""},
      {"newmtl a\nKd 1 x 1", "m.mtl:2:6: error: a number is none\n  got \"x\", expected a number such as 0.25"},
      {"newmtl a\nKd 0,5 0 0", "got \"0,5\""},
      {"newmtl a\nKd 1.1 0 0", "m.mtl:2:4: error: a number is out of range\n  got \"1.1\", expected 0 to 1"},
      {"newmtl a\nKd 0 0 -0.01", "m.mtl:2:8: error: a number is out of range\n  got \"-0.01\""},
      {"newmtl a\nKd nan 0 0", "m.mtl:2:4: error: a number is out of range\n  got \"nan\""},
      {"newmtl a\nKd 0 inf 0", "got \"inf\", expected 0 to 1"},
      {"newmtl a\nKd 1e999", "got \"1e999\", expected 0 to 1"},
      {"newmtl a\nKd 255 255 255", "got \"255\", expected 0 to 1"},
      {"newmtl a\nKd spectral a.rfl 1",
       "m.mtl:2:4: error: only colours of red, green and blue are read\n  got \"spectral\", expected Kd 0.8"},
      {"newmtl a\nKd xyz 1 1 1", "got \"xyz\""},
      {"newmtl a\nKd \x1b[31m", "got \"\\x1b[31m\""},
      {"newmtl a\n#!nir_reflectivity", "m.mtl:2:19: error: a number is missing"},
      {"newmtl a\n#!nir_reflectivity 1.5", "m.mtl:2:20: error: a number is out of range\n  got \"1.5\", expected 0 to 1"},
      {"newmtl a\n#!nir_reflectivity 60%", "m.mtl:2:20: error: a number is none\n  got \"60%\""},
      {"newmtl a\n#!nir_reflectivity 0.5 0.5", "m.mtl:2:1: error: the line goes on"},
      {"newmtl a\n#!nir_reflectivty 0.5",
       "m.mtl:2:1: error: unknown statement \"#!nir_reflectivty\"; did you mean \"#!nir_reflectivity\"?"},
      {"newmtl a\n#!NIR_reflectivity 0.5", "did you mean \"#!nir_reflectivity\"?"},
      {"newmtl a\nmap_Kd", "m.mtl:2:7: error: the name of a picture is missing"},
      {"newmtl a\nmap_Kd -s", "m.mtl:2:10: error: an option's number is missing"},
      {"newmtl a\nmap_Kd -s a.png", "m.mtl:2:11: error: a number is none\n  got \"a.png\" behind -s"},
      {"newmtl a\nmap_Kd -s 1 1 1", "m.mtl:2:16: error: the name of a picture is missing"},
      {"newmtl a\nmap_Kd -o 1 nan a.png", "m.mtl:2:13: error: a number is out of range\n  got \"nan\", expected up to 1e6"},
      {"newmtl a\nmap_Kd -s 1e7 a.png", "got \"1e7\", expected up to 1e6"},
      {"newmtl a\nmap_Kd -o -inf a.png", "got \"-inf\", expected up to 1e6"},
      {"newmtl a\nmap_Kd -clamp", "m.mtl:2:14: error: an option's value is missing"},
      {"newmtl a\nmap_Kd -clamp a.png", "m.mtl:2:15: error: -clamp is neither on nor off\n  got \"a.png\""},
      {"newmtl a\nmap_Kd -clamp on", "m.mtl:2:17: error: the name of a picture is missing"},
      {"newmtl a\nmap_Kd -", "an option's value is missing"},
      {"newmtl a\nmap_Kd -colorspace sRGB", "m.mtl:2:24: error: the name of a picture is missing"},
      {"newmtl a\nmap_Kd -mm 0", "the name of a picture is missing"},
      {"newmtl a\nmap_Kd -bm x a.png", "got \"x\" behind -bm"},
      {"newmtl a\\\n b\nKd 2", "m.mtl:3:4: error: a number is out of range"},
  };
  for (const Fault& fault : faults) {
    SCOPED_TRACE(base::printable(fault.bytes));
    const std::string message = message_of(fault.bytes);
    EXPECT_TRUE(test::has(message, fault.message)) << message << "\nexpected: " << fault.message;
  }
}

TEST(mtl, cut_short_or_changed_is_an_error_or_materials) {
  for (std::size_t size = 0; size < full_mtl.size(); ++size) (void)gives_materials(full_mtl.substr(0, size));
  std::size_t taken = 0, refused = 0;
  for (std::size_t at = 0; at < full_mtl.size(); ++at)
    for (const char byte : {'\0', '\xFF', '\x80', '\n', '\r', ' ', '-', '9', '\\', '#', '!', 'e'}) {
      std::string changed = full_mtl;
      changed[at] = byte;
      SCOPED_TRACE(at);
      (gives_materials(changed) ? taken : refused) += 1;
    }
  EXPECT_GT(taken, 500U);
  EXPECT_GT(refused, 300U);
  out_test::Random random(11);
  for (int trial = 0; trial < 20000; ++trial) {
    std::string changed = full_mtl;
    for (std::size_t changes = 1 + random.below(5); changes > 0 && !changed.empty(); --changes) {
      const std::size_t at = random.below(changed.size()), from = random.below(changed.size());
      if (random.below(2) == 0)
        changed[at] = static_cast<char>(random.next());
      else
        changed.replace(at, random.below(20), changed.substr(from, random.below(20)));
    }
    SCOPED_TRACE(base::printable(changed));
    (void)gives_materials(changed);
  }
}

TEST(mtl, is_read_as_other_programs_write_it) {
  const mesh::Mtl read = mesh::parse_mtl(
      "NEWMTL a\nKD 0.5\nmap_kd -colorspace sRGB -rotate 5 \"wood grain.png\"\nnewmtl\nKd 0.25\nnewmtl b\nMAP_KD C:\\maps\\b.png\n",
      "m.mtl", 10);
  ASSERT_EQ(read.materials.size(), 3U);
  EXPECT_EQ(read.materials[0].name, "a");
  EXPECT_EQ(read.materials[0].color, (std::array<double, 3>{0.5, 0.5, 0.5}));
  EXPECT_EQ(read.materials[0].picture->reference.file, "wood grain.png");
  EXPECT_EQ(read.left_out, (std::vector<std::string>{"-colorspace of map_Kd", "-rotate of map_Kd"}));
  EXPECT_EQ(read.materials[1].name, "");
  EXPECT_EQ(read.materials[1].color, (std::array<double, 3>{0.25, 0.25, 0.25}));
  EXPECT_EQ(read.materials[2].picture->reference.file, "C:/maps/b.png");
}
