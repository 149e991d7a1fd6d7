// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Materials, textures, images; extensions and what is said of those that are left out.
#include "base/limits.h"
#include "gltf_files.h"

using namespace tofray;
using namespace tofray::gltf_test;

namespace {

const std::string png = std::string("\x89PNG\r\n\x1A\n", 8) + "pixels";

File textured_file() {
  File file = triangle_file();
  file.json["images"] = {{{"bufferView", file.view(png)}, {"mimeType", "image/png"}, {"name", "skin"}}, {{"uri", "unused.jpg"}}};
  file.json["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}}, Document::object()};
  file.json["textures"] = {{{"source", 0}, {"sampler", 0}}, {{"source", 0}, {"sampler", 1}}, {{"source", 0}}, Document::object()};
  file.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
  return file;
}

gltf::Material material_of(const Document& material) {
  File file = textured_file();
  file.json["materials"] = Document::array({material});
  return model_of(file).materials.at(0);
}

}  // namespace

TEST(material, that_says_nothing_is_a_white_metal) {
  const gltf::Material m = material_of(Document::object());
  EXPECT_EQ(m.base_color, (std::array<double, 4>{1, 1, 1, 1}));
  EXPECT_EQ(m.metallic, 1);
  EXPECT_EQ(m.roughness, 1);
  EXPECT_EQ(m.base_color_texture.texture, gltf::none);
  EXPECT_EQ(m.alpha, gltf::Material::Alpha::opaque);
  EXPECT_EQ(m.alpha_cutoff, 0.5);
  EXPECT_FALSE(m.double_sided);
  EXPECT_FALSE(m.unlit);
  EXPECT_FALSE(m.nir_reflectivity);
  EXPECT_FALSE(m.nir_material);
  EXPECT_FALSE(m.has_metallic_roughness);
  EXPECT_EQ(m.ior, 1.5);
  EXPECT_EQ(m.specular, 1);
}

TEST(material, says_what_it_is) {
  const gltf::Material m = material_of({{"name", "wood"},
                                        {"pbrMetallicRoughness",
                                         {{"baseColorFactor", {0.1, 0.2, 0.3, 0.4}},
                                          {"metallicFactor", 0.5},
                                          {"roughnessFactor", 0.25},
                                          {"baseColorTexture", {{"index", 1}, {"texCoord", 1}}},
                                          {"metallicRoughnessTexture", {{"index", 2}}}}},
                                        {"normalTexture", {{"index", 0}, {"scale", -2.5}}},
                                        {"alphaMode", "MASK"},
                                        {"alphaCutoff", 0.75},
                                        {"doubleSided", true},
                                        {"extensions",
                                         {{"KHR_materials_unlit", Document::object()},
                                          {"KHR_materials_ior", {{"ior", 1.25}}},
                                          {"KHR_materials_specular", {{"specularFactor", 0.5}}}}},
                                        {"extras", {{"nir_reflectivity", 0.8}, {"other", "thing"}}}});
  EXPECT_EQ(m.name, "wood");
  EXPECT_EQ(m.base_color, (std::array<double, 4>{0.1, 0.2, 0.3, 0.4}));
  EXPECT_EQ(m.metallic, 0.5);
  EXPECT_EQ(m.roughness, 0.25);
  EXPECT_EQ(m.base_color_texture.texture, 1);
  EXPECT_EQ(m.base_color_texture.texcoord, 1);
  EXPECT_EQ(m.metallic_roughness_texture.texture, 2);
  EXPECT_EQ(m.normal_texture.texture, 0);
  EXPECT_EQ(m.normal_scale, -2.5);
  EXPECT_EQ(m.alpha, gltf::Material::Alpha::mask);
  EXPECT_EQ(m.alpha_cutoff, 0.75);
  EXPECT_TRUE(m.double_sided);
  EXPECT_TRUE(m.unlit);
  EXPECT_TRUE(m.has_metallic_roughness);
  EXPECT_EQ(m.ior, 1.25);
  EXPECT_EQ(m.specular, 0.5);
  EXPECT_EQ(m.nir_reflectivity, 0.8);
  EXPECT_EQ(material_of({{"alphaMode", "BLEND"}}).alpha, gltf::Material::Alpha::blend);
}

TEST(material, takes_its_reflectivity_from_its_extras_within_0_and_1) {
  for (const double good : {0.0, 1.0}) EXPECT_EQ(material_of({{"extras", {{"nir_reflectivity", good}}}}).nir_reflectivity, good);
  EXPECT_FALSE(material_of({{"extras", {{"reflectivity", 2}}}}).nir_reflectivity);
  for (const Document& other : {Document(5), Document("text"), Document::array({1}), Document(nullptr)})
    EXPECT_FALSE(material_of({{"extras", other}}).nir_reflectivity);
  File file = textured_file();
  for (const double bad : {-0.001, 1.001, 1e308, -1e308}) {
    file.json["materials"][0]["extras"] = {{"nir_reflectivity", bad}};
    expect_fault(file.glb(), "m: error: materials[0].extras.nir_reflectivity is out of range");
  }
  file.json["materials"][0]["extras"] = {{"nir_reflectivity", "0.5"}};
  expect_fault(file.glb(), "m: error: materials[0].extras.nir_reflectivity is not a number\n  got \"0.5\"");
}

TEST(material, may_name_one_that_tofray_has) {
  EXPECT_EQ(material_of({{"extras", {{"nir_material", "skin"}}}}).nir_material, "skin");
  File file = textured_file();
  file.json["materials"][0]["extras"] = {{"nir_material", 5}};
  expect_fault(file.glb(), "m: error: materials[0].extras.nir_material is not a string\n  got 5");
  file.json["materials"][0]["extras"] = {{"nir_material", "skin"}, {"nir_reflectivity", 0.5}};
  expect_fault(file.glb(), "m: error: materials[0].extras has nir_reflectivity and nir_material");
}

TEST(material, says_what_is_left_out_of_its_mirror) {
  File file = textured_file();
  for (const Document& said : {Document{{"specularTexture", {{"index", 0}}}},
                               {{"specularColorTexture", {{"index", 0}}}},
                               {{"specularColorFactor", {1, 0.5, 1}}}}) {
    file.json["materials"][0]["extensions"]["KHR_materials_specular"] = said;
    EXPECT_TRUE(has_notice(model_of(file), "colours and textures of KHR_materials_specular are left out"));
  }
  file.json["materials"][0]["extensions"]["KHR_materials_specular"] = {{"specularColorFactor", {1, 1, 1}}};
  EXPECT_TRUE(model_of(file).notices.empty());
}

TEST(material, has_textures_that_are_turned_and_scaled) {
  const auto use =
      material_of({{"pbrMetallicRoughness",
                    {{"baseColorTexture",
                      {{"index", 1},
                       {"texCoord", 1},
                       {"extensions",
                        {{"KHR_texture_transform", {{"offset", {0.5, -1}}, {"rotation", 1.25}, {"scale", {2, 3}}, {"texCoord", 0}}}}}}}}}})
          .base_color_texture;
  EXPECT_EQ(use.offset, (std::array<double, 2>{0.5, -1}));
  EXPECT_EQ(use.scale, (std::array<double, 2>{2, 3}));
  EXPECT_EQ(use.rotation_rad, 1.25);
  EXPECT_EQ(use.texcoord, 0);
}

TEST(material, says_that_it_does_not_shine) {
  File file = textured_file();
  EXPECT_TRUE(model_of(file).notices.empty());
  file.json["materials"][0]["emissiveFactor"] = {0, 0, 0.1};
  EXPECT_TRUE(has_notice(model_of(file), "light that materials emit is left out"));
}

TEST(material, leaves_out_textures_without_image_and_at_other_coordinates) {
  File file = textured_file();
  Document& texture = file.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"];
  texture["index"] = 3;
  Model model = model_of(file);
  EXPECT_EQ(model.materials[0].base_color_texture.texture, gltf::none);
  EXPECT_TRUE(has_notice(model, "textures without an image are left out"));
  texture = {{"index", 0}, {"texCoord", 2}};
  model = model_of(file);
  EXPECT_EQ(model.materials[0].base_color_texture.texture, gltf::none);
  EXPECT_TRUE(has_notice(model, "coordinates beyond set 1"));
}

TEST(texture, says_how_it_is_repeated) {
  const Model model = model_of(textured_file());
  ASSERT_EQ(model.textures.size(), 4U);
  EXPECT_EQ(model.textures[0].wrap_s, gltf::Texture::Wrap::clamp);
  EXPECT_EQ(model.textures[0].wrap_t, gltf::Texture::Wrap::mirror);
  for (const std::size_t i : {1U, 2U, 3U}) EXPECT_EQ(model.textures[i].wrap_s, gltf::Texture::Wrap::repeat);
  EXPECT_EQ(model.textures[1].image, 0);
  EXPECT_EQ(model.textures[3].image, gltf::none);
}

TEST(image, has_the_bytes_of_a_view_a_data_uri_or_a_file) {
  File file = textured_file();
  Model model = model_of(file);
  EXPECT_EQ(model.images[0].bytes, png);
  EXPECT_EQ(model.images[0].mime_type, "image/png");
  EXPECT_EQ(model.images[0].name, "skin");
  EXPECT_EQ(model.images[1].bytes, "");  // no material uses it: it is not asked for
  file.json["images"][0] = {{"uri", "data:image/jpeg;base64," + base64("\xFF\xD8\xFFjpeg")}};
  model = model_of(file);
  EXPECT_EQ(model.images[0].bytes, "\xFF\xD8\xFFjpeg");
  EXPECT_EQ(model.images[0].mime_type, "image/jpeg");
  file.json["images"][0] = {{"uri", "a.png"}, {"mimeType", "image/jpeg"}};
  model = read("m", file.glb(), [](const std::string& path, std::size_t most) {
    EXPECT_EQ(path, "a.png");
    EXPECT_EQ(most, static_cast<std::size_t>(base::limit::gltf_image_bytes.value));
    return png;
  });
  EXPECT_EQ(model.images[0].bytes, png);
  EXPECT_EQ(model.images[0].mime_type, "image/png");  // as its first bytes say
}

TEST(image, of_too_many_bytes_is_refused) {
  File file = textured_file();
  file.json["images"] = {{{"uri", "a"}}, {{"uri", "b"}}};
  file.json["textures"][1]["source"] = 1;
  file.json["materials"][0]["normalTexture"] = {{"index", 1}};
  const auto half = [](const std::string&, std::size_t most) {
    return std::string(most == static_cast<std::size_t>(base::limit::gltf_image_bytes.value) ? most / 2 : most + 1, 'x');
  };
  EXPECT_TRUE(test::has(message_of(file.glb(), ErrorKind::limit, half), "m: error: images[1].uri has too many bytes"));
}

TEST(extension, that_is_required_and_not_read_is_refused_with_the_way_out) {
  const auto message = [](const std::string& name) {
    File file = triangle_file();
    file.json["extensionsRequired"] = {name};
    return message_of(file.glb());
  };
  EXPECT_EQ(message("KHR_draco_mesh_compression"),
            "m: error: the file requires the extension \"KHR_draco_mesh_compression\", which cannot be read\n  export without Draco "
            "compression");
  EXPECT_TRUE(test::has(message("EXT_meshopt_compression"), "export without meshopt compression"));
  EXPECT_TRUE(test::has(message("KHR_texture_basisu"), "export with textures as PNG or JPEG"));
  EXPECT_TRUE(test::has(message("VENDOR_unknown"), "expected an export without it"));
  EXPECT_TRUE(test::has(message("KHR_texture_transform2"), "cannot be read"));
}

TEST(extension, that_is_read_may_be_required) {
  for (const char* name : {"KHR_texture_transform", "KHR_mesh_quantization", "KHR_materials_unlit", "KHR_materials_ior",
                           "KHR_materials_specular", "EXT_mesh_gpu_instancing", "KHR_materials_pbrSpecularGlossiness"}) {
    File file = triangle_file();
    file.json["extensionsRequired"] = file.json["extensionsUsed"] = {name};
    EXPECT_TRUE(model_of(file).notices.empty());
  }
}

TEST(extension, that_is_used_and_not_read_is_named_once) {
  File file = triangle_file();
  file.json["extensionsUsed"] = {"KHR_lights_punctual", "KHR_materials_variants", "KHR_texture_transform"};
  file.json["extensionsRequired"] = {"KHR_lights_punctual"};
  EXPECT_EQ(model_of(file).notices,
            (std::vector<std::string>{"lights (KHR_lights_punctual) are left out",
                                      "the variants of KHR_materials_variants are left out: materials are the file's own"}));
}

// What is required, and changes how a surface looks and no place of it, lets the file through and is told.
TEST(extension, that_changes_looks_alone_may_be_required) {
  for (const char* name :
       {"KHR_materials_variants", "KHR_materials_transmission", "KHR_materials_emissive_strength", "KHR_materials_clearcoat",
        "KHR_materials_sheen", "KHR_materials_volume", "KHR_materials_iridescence", "KHR_materials_anisotropy", "KHR_materials_dispersion",
        "KHR_materials_diffuse_transmission", "EXT_lights_image_based", "KHR_xmp_json_ld"}) {
    File file = triangle_file();
    file.json["extensionsRequired"] = {name};
    for (const bool used : {true, false}) {
      if (used) file.json["extensionsUsed"] = {name};
      if (!used) file.json.erase("extensionsUsed");
      const Model model = model_of(file);
      EXPECT_EQ(model.notices.size(), 1U) << name;
      EXPECT_TRUE(has_notice(model, name)) << name;
      EXPECT_EQ(parts_at_rest(model).size(), 1U);
    }
  }
}

// diffuse (0.2, 0.4, 0.6) and glossiness 0.75: base colour, and roughness 0.25 of what is no metal.
TEST(extension, of_specular_and_glossiness_gives_base_colour_and_roughness) {
  File file = triangle_file();
  file.json["materials"] = {
      {{"extensions", {{"KHR_materials_pbrSpecularGlossiness", {{"diffuseFactor", {0.2, 0.4, 0.6, 1}}, {"glossinessFactor", 0.75}}}}}}};
  const Model model = model_of(file);
  EXPECT_EQ(model.materials[0].base_color, (std::array<double, 4>{0.2, 0.4, 0.6, 1}));
  EXPECT_EQ(model.materials[0].metallic, 0);
  EXPECT_EQ(model.materials[0].roughness, 0.25);
  EXPECT_TRUE(has_notice(model, "KHR_materials_pbrSpecularGlossiness are taken for base colours"));
  // Where both are there, the newer one counts, as the extension says of readers that know it not.
  file.json["materials"][0]["pbrMetallicRoughness"] = {{"baseColorFactor", {0.5, 0.5, 0.5, 1}}};
  EXPECT_EQ(model_of(file).materials[0].base_color[0], 0.5);
}

TEST(extension, that_packs_what_a_primitive_needs_is_refused) {
  File file = triangle_file();
  file.primitive(0)["extensions"]["KHR_draco_mesh_compression"] = Document::object();
  EXPECT_EQ(parts_at_rest(model_of(file)).size(), 1U);  // not needed: the plain bytes are there, too
  file.json["accessors"][0].erase("bufferView");
  expect_fault(file.glb(), "meshes[0].primitives[0] is compressed by Draco, which cannot be read");
  file = triangle_file();
  file.json["buffers"] = {{{"byteLength", 36}}, {{"byteLength", 36}}};
  file.json["bufferViews"][0]["buffer"] = 1;
  file.json["bufferViews"][0]["extensions"]["EXT_meshopt_compression"] = Document::object();
  expect_fault(file.glb(), "bufferViews[0] is packed\n  EXT_meshopt_compression cannot be read: export without meshopt compression");
}

TEST(notices, are_not_without_end) {
  File file = triangle_file();
  for (int i = 0; i < 1000; ++i) file.json["extensionsUsed"].push_back("X_" + std::to_string(i));
  const Model model = model_of(file);
  ASSERT_EQ(model.notices.size(), 51U);
  EXPECT_EQ(model.notices.back(), "and 950 more");
  file = triangle_file();
  file.primitive(0)["mode"] = 0;
  const Document primitive = file.primitive(0);
  file.json["meshes"][0]["primitives"] = {primitive, primitive, primitive};
  EXPECT_EQ(model_of(file).notices, std::vector<std::string>{"primitives of points or lines are left out (3 times)"});
}
