// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// One fault each in a file that has all that is read, and what the error says of it.
#include "faults.h"

using namespace tofray;
using namespace tofray::gltf_test;

TEST(gltf_fault, of_a_version_view_or_accessor_is_told) {
  expect_each({
      {"/asset/version", "\"1.0\"", "asset.version is not 2.0\n  got \"1.0\": export it as glTF 2.0"},
      {"/asset/version", "\"3.0\"", "asset.version is not 2.0"},
      {"/asset/version", "\"20\"", "asset.version is not 2.0"},
      {"/asset/minVersion", "\"2.1\"", "asset.minVersion is not 2.0"},
      {"/buffers/0/byteLength", "100000", "buffers[0] is cut short\n  its byteLength is 100000, and there are "},
      {"/buffers/0/byteLength", "10", "bufferViews[0] ends outside its buffer"},
      {"/bufferViews/0/byteOffset", "100000", "bufferViews[0] ends outside its buffer"},
      {"/bufferViews/0/byteOffset", "9007199254740992", "bufferViews[0] ends outside its buffer"},
      {"/bufferViews/0/byteLength", "9007199254740992", "bufferViews[0] ends outside its buffer"},
      {"/bufferViews/0/byteLength", "35",
       "accessors[0] ends outside its view\n  got 3 elements of 12 bytes each from byte 0 on, 12 bytes apart; "},
      {"/bufferViews/0/byteStride", "0", "bufferViews[0].byteStride is 0"},
      {"/bufferViews/0/byteStride", "11",
       "accessors[0] has elements that overlap\n  each has 12 bytes, and bufferViews[0] has a byteStride of 11"},
      {"/bufferViews/0/byteStride", "13", "accessors[0] ends outside its view"},
      {"/bufferViews/0/byteStride", "9007199254740992", "accessors[0] ends outside its view"},
      {"/accessors/0/count", "4", "accessors[0] ends outside its view"},
      {"/accessors/0/count", "9007199254740992", "accessors[0] ends outside its view"},
      {"/accessors/0/count", "1537228672809129302", "accessors[0].count is not a whole number"},  // times 12: 2^64 + 8
      {"/accessors/0/byteOffset", "1", "accessors[0] ends outside its view"},
      {"/accessors/0/byteOffset", "9007199254740992", "accessors[0] ends outside its view"},
      {"/accessors/0/type", "\"VEC5\"", "accessors[0].type is none of an accessor\n  got \"VEC5\""},
      {"/accessors/0/type", "\"vec3\"", "accessors[0].type is none of an accessor"},
      {"/accessors/0/type", "\"MAT3\"", "accessors[0] ends outside its view"},
      {"/accessors/0/componentType", "5124", "accessors[0].componentType is none of an accessor\n  got 5124"},
      {"/accessors/0/componentType", "5130", "accessors[0].componentType is none of an accessor"},
      {"/accessors/0/componentType", "0", "accessors[0].componentType is none of an accessor"},
      {"/accessors/0/normalized", "true", "accessors[0].normalized is true of numbers that cannot be normalized"},
      {"/accessors/7/sparse/count", "4", "accessors[7].sparse.count is more than the accessor has\n  got 4, and there are 3"},
      {"/accessors/7/sparse/count", "2", "accessors[7].sparse.indices ends outside its view"},
      {"/accessors/7/sparse/indices/componentType", "5126", "accessors[7].sparse.indices.componentType is none of indices"},
      {"/accessors/7/sparse/indices/componentType", "5120", "accessors[7].sparse.indices.componentType is none of indices"},
      {"/accessors/7/sparse/indices/componentType", "5123", "accessors[7].sparse.indices ends outside its view"},
      {"/accessors/7/sparse/indices/byteOffset", "1", "accessors[7].sparse.indices ends outside its view"},
      {"/accessors/7/sparse/values/byteOffset", "4", "accessors[7].sparse.values ends outside its view"},
  });
}

TEST(gltf_fault, of_a_mesh_is_told) {
  expect_each({
      {"/meshes/0/primitives", "[]", "meshes[0].primitives are missing"},
      {"/meshes/0/primitives", "[1]", "meshes[0].primitives[0] is not an object\n  got 1"},
      {"/meshes/0/primitives/0/mode", "7", "meshes[0].primitives[0].mode is none of a primitive\n  got 7, expected 0 to 6"},
      {"/meshes/0/weights", "[1, 2]", "meshes[0].weights are not one for each morph target\n  got 2, and there are 1"},
      {"/meshes/0/weights", "[]", "meshes[0].weights are not one for each morph target"},
      {"/meshes/0/primitives/1", R"({"attributes": {"POSITION": 0}})", "meshes[0].primitives[1].targets are not as many as"},
      {"/meshes/0/primitives/0/attributes/POSITION", "2",
       "accessors[2] is not what meshes[0].primitives[0].attributes needs\n  got VEC2 of floats"},
      {"/meshes/0/primitives/0/attributes/NORMAL", "3",
       "accessors[3] is not what meshes[0].primitives[0].attributes needs\n  got VEC3 of normalized "
       "unsigned bytes"},
      {"/meshes/0/primitives/0/attributes/TEXCOORD_0", "0", "accessors[0] is not what"},
      {"/meshes/0/primitives/0/attributes/COLOR_0", "2", "accessors[2] is not what"},
      {"/meshes/0/primitives/0/attributes/JOINTS_0", "5", "accessors[5] is not what"},
      {"/meshes/0/primitives/0/attributes/WEIGHTS_0", "4", "accessors[4] is not what"},
      {"/meshes/0/primitives/0/attributes/NORMAL", "9",
       "meshes[0].primitives[0].attributes.NORMAL has not one element for each vertex\n  got 2, and"},
      {"/meshes/0/primitives/0/attributes/_OTHER", "9", "meshes[0].primitives[0].attributes._OTHER has not one element for each vertex"},
      {"/meshes/0/primitives/0/targets/0/NORMAL", "9", "meshes[0].primitives[0].targets[0].NORMAL has not one element for each vertex"},
      {"/meshes/0/primitives/0/targets/0/POSITION", "2", "accessors[2] is not what meshes[0].primitives[0].targets[0] needs"},
      {"/meshes/0/primitives/0/indices", "0", "accessors[0] is not what meshes[0].primitives[0] needs"},
      {"/meshes/0/primitives/0/indices", "9", "accessors[9] is not what meshes[0].primitives[0] needs\n  got SCALAR of floats"},
      {"/accessors/6/normalized", "true", "accessors[6] is not what meshes[0].primitives[0] needs"},
      {"/accessors/6/componentType", "5120", "accessors[6] is not what meshes[0].primitives[0] needs"},
      {"/accessors/4/normalized", "true", "accessors[4] is not what"},
      {"/accessors/5/normalized", "false", "accessors[5] is not what"},
      {"/meshes/0/primitives/0/attributes/JOINTS_0", "", "meshes[0].primitives[0].attributes has only one of JOINTS_0 and WEIGHTS_0"},
      {"/meshes/0/primitives/0/attributes/WEIGHTS_0", "", "meshes[0].primitives[0].attributes has only one of JOINTS_0 and WEIGHTS_0"},
      {"/bufferViews/6/byteOffset", "13",
       "accessors[6] has an index that is none of the vertices of meshes[0].primitives[0]\n  got 128, and there are 3"},
  });
}

TEST(gltf_fault, of_a_node_scene_skin_or_camera_is_told) {
  expect_each({
      {"/nodes/1/translation", "[1, 2]", "nodes[1].translation is not a list of 3 numbers\n  got 2"},
      {"/nodes/1/scale", "[1, 2, 3, 4]", "nodes[1].scale is not a list of 3 numbers"},
      {"/nodes/1/rotation", "[0, 0, 1]", "nodes[1].rotation is not a list of 4 numbers"},
      {"/nodes/1/rotation", "[0, 0, 0, 0]", "nodes[1].rotation is no rotation\n  got a quaternion of length 0"},
      {"/nodes/1/rotation", "[1e308, 0, 0, 0]", "nodes[1].rotation is no rotation"},
      {"/nodes/3/matrix", "[1]", "nodes[3].matrix is not a list of 16 numbers"},
      {"/nodes/3/matrix/3", "0.5", "nodes[3].matrix has a last row that is not 0 0 0 1\n  got 0.5"},
      {"/nodes/3/matrix/15", "0", "nodes[3].matrix has a last row that is not 0 0 0 1"},
      {"/nodes/3/translation", "[0, 0, 0]", "nodes[3] has a matrix and a translation, rotation or scale"},
      {"/nodes/0/weights", "[1, 2]", "nodes[0].weights are not one for each morph target\n  got 2, and there are 1"},
      {"/nodes/2/weights", "[1]", "nodes[2].weights are not one for each morph target\n  got 1, and there are 0"},
      {"/nodes/2/children", "[2]", "nodes[2] has two parents"},
      {"/nodes/2/children", "[1]", "nodes[1] is below itself"},
      {"/nodes/0/children", "[0]", "nodes[0] is below itself"},
      {"/nodes/3/children", "[2]", "nodes[2] has two parents"},
      {"/nodes/1/children", "[2, 2]", "nodes[1].children names 2 twice"},
      {"/nodes/2/skin", "0", "nodes[2].skin is that of a node without a mesh"},
      {"/scenes/0/nodes", "[2]", "scenes[0].nodes has a node with a parent"},
      {"/scenes/0/nodes", "[0, 0]", "scenes[0].nodes names 0 twice"},
      {"/skins/0/joints", "[]", "skins[0].joints are missing"},
      {"/skins/0/joints", "[1, 1]", "skins[0].joints names 1 twice"},
      {"/skins/0/joints", "[1, 2, 3]", "skins[0].inverseBindMatrices has too few matrices"},
      {"/skins/0/joints", "[2]", "nodes[0].skin has fewer joints than its mesh names"},
      {"/skins/0/inverseBindMatrices", "0", "accessors[0] is not what skins[0] needs"},
      {"/cameras/0/type", "\"fisheye\"", "cameras[0].type is none of a camera\n  got \"fisheye\""},
      {"/cameras/0/perspective/yfov", "0", "cameras[0].perspective.yfov is out of range"},
      {"/cameras/0/perspective/yfov", "-1", "cameras[0].perspective.yfov is out of range"},
      {"/cameras/0/perspective/aspectRatio", "0", "cameras[0].perspective.aspectRatio is out of range"},
      {"/cameras/0/perspective/znear", "0", "cameras[0].perspective.znear is out of range"},
      {"/cameras/0/perspective/zfar", "0.1", "cameras[0].perspective.zfar is not beyond znear"},
      {"/cameras/1/orthographic/znear", "-1", "cameras[1].orthographic.znear is out of range"},
      {"/cameras/1/orthographic/zfar", "0", "cameras[1].orthographic.zfar is not beyond znear"},
      {"/cameras/1/orthographic/xmag", "0", "cameras[1].orthographic.xmag is out of range"},
      {"/cameras/1/orthographic/ymag", "-2", "cameras[1].orthographic.ymag is out of range"},
  });
}

TEST(gltf_fault, of_a_material_or_image_is_told) {
  expect_each({
      {"/materials/0/pbrMetallicRoughness/baseColorFactor", "[1, 1, 1]",
       "materials[0].pbrMetallicRoughness.baseColorFactor is not a list of 4 numbers"},
      {"/materials/0/pbrMetallicRoughness/baseColorFactor/2", "1.5", "materials[0].pbrMetallicRoughness.baseColorFactor is out of range"},
      {"/materials/0/pbrMetallicRoughness/baseColorFactor/3", "-0.1", "materials[0].pbrMetallicRoughness.baseColorFactor is out of range"},
      {"/materials/0/pbrMetallicRoughness/metallicFactor", "2", "materials[0].pbrMetallicRoughness.metallicFactor is out of range"},
      {"/materials/0/pbrMetallicRoughness/roughnessFactor", "-1", "materials[0].pbrMetallicRoughness.roughnessFactor is out of range"},
      {"/materials/0/pbrMetallicRoughness/roughnessFactor", "1e308", "materials[0].pbrMetallicRoughness.roughnessFactor is out of range"},
      {"/materials/0/emissiveFactor", "[1]", "materials[0].emissiveFactor is not a list of 3 numbers"},
      {"/materials/0/alphaMode", "\"opaque\"", "materials[0].alphaMode is none\n  got \"opaque\", expected OPAQUE, MASK or BLEND"},
      {"/materials/0/alphaCutoff", "-1", "materials[0].alphaCutoff is out of range"},
      {"/materials/0/extras/nir_reflectivity", "1.1", "materials[0].extras.nir_reflectivity is out of range\n  got 1.1, expected 0 to 1"},
      {"/materials/0/extras/nir_reflectivity", "-0.1", "materials[0].extras.nir_reflectivity is out of range"},
      {"/materials/0/extras/nir_material", "\"skin\"", "materials[0].extras has nir_reflectivity and nir_material\n  these keys say"},
      {"/materials/0/pbrMetallicRoughness/metallicFactor", "-0.001", "materials[0].pbrMetallicRoughness.metallicFactor is out of range"},
      {"/materials/0/pbrMetallicRoughness/roughnessFactor", "1.001", "materials[0].pbrMetallicRoughness.roughnessFactor is out of range"},
      {"/materials/0/pbrMetallicRoughness/metallicRoughnessTexture/index", "1",
       "materials[0].pbrMetallicRoughness.metallicRoughnessTexture.index is none of the textures"},
      {"/materials/0/extensions/KHR_materials_ior/ior", "0.999",
       "materials[0].extensions.KHR_materials_ior.ior is out of range\n  got 0.999, expected 1 or more, or 0"},
      {"/materials/0/extensions/KHR_materials_ior/ior", "-1", "materials[0].extensions.KHR_materials_ior.ior is out of range"},
      {"/materials/0/extensions/KHR_materials_specular/specularFactor", "1.1",
       "materials[0].extensions.KHR_materials_specular.specularFactor is out of range\n  got 1.1, expected 0 to 1"},
      {"/materials/0/extensions/KHR_materials_specular/specularFactor", "-1",
       "materials[0].extensions.KHR_materials_specular.specularFactor is out of range"},
      {"/materials/0/extensions/KHR_materials_specular/specularColorFactor", "[1, 1]",
       "materials[0].extensions.KHR_materials_specular.specularColorFactor is not a list of 3 numbers"},
      {"/accessors/3/componentType", "5120", "accessors[3] is not what meshes[0].primitives[0].attributes needs"},
      {"/accessors/3/normalized", "false", "accessors[3] is not what meshes[0].primitives[0].attributes needs"},
      {"/materials/0/normalTexture/extensions/KHR_texture_transform/offset", "[0]",
       "materials[0].normalTexture.extensions.KHR_texture_transform.offset is not a list of 2 numbers"},
      {"/materials/0/normalTexture/extensions/KHR_texture_transform/scale", "[0, 0, 0]",
       "materials[0].normalTexture.extensions.KHR_texture_transform.scale is not a list of 2 numbers"},
      {"/samplers/0/wrapS", "1", "samplers[0].wrapS is no way to wrap\n  got 1"},
      {"/samplers/0/wrapT", "33072", "samplers[0].wrapT is no way to wrap"},
      {"/images/0/bufferView", "", "images[0] has not one of uri and bufferView\n  got neither"},
      {"/images/0/uri", "\"a.png\"", "images[0] has not one of uri and bufferView\n  got both"},
      {"/images/0", R"({"uri": "http://a/b.png"})", "images[0].uri has the scheme \"http\""},
      {"/images/0", R"({"uri": "../b.png"})", "images[0].uri leads out of its folder"},
      {"/images/0", R"({"uri": "data:image/png;base64,A"})", "images[0].uri has broken base64"},
  });
}

TEST(gltf_fault, of_an_animation_is_told) {
  expect_each({
      {"/animations/0/samplers/0/interpolation", "\"linear\"", "animations[0].samplers[0].interpolation is none\n  got \"linear\""},
      {"/animations/0/samplers/0/input", "0", "animations[0].samplers[0].output has not the values that its keyframes need"},
      {"/animations/0/samplers/0/output", "0",
       "animations[0].samplers[0].output has not the values that its keyframes need\n  got 3 elements"},
      {"/animations/0/samplers/0/output", "11", "accessors[11] is not what animations[0].samplers[0] needs"},
      {"/animations/0/samplers/1/output", "10", "accessors[10] is not what animations[0].samplers[1] needs"},
      {"/animations/0/samplers/1/interpolation", "\"CUBICSPLINE\"", "animations[0].samplers[1].output has not the values"},
      {"/animations/0/samplers/2/interpolation", "\"LINEAR\"", "animations[0].samplers[2].output has not the values"},
      {"/animations/0/channels/1/target", R"({"node": 1, "path": "translation"})",
       "animations[0].channels[1] has the target of another channel"},
      {"/animations/0/channels/0/target/path", "\"visibility\"", "animations[0].channels[0].target.path is none of a node"},
      {"/animations/0/channels/0/target/node", "3", "animations[0].channels[0].target.node has a matrix"},
      {"/animations/0/channels/2/target/node", "1", "animations[0].channels[2].target.node has no morph targets"},
      {"/accessors/9/count", "1", "animations[0].samplers[0].output has not the values"},
      {"/accessors/9/count", "0", "animations[0].samplers[0].input has too few keyframes"},
      {"/accessors/9/type", "\"VEC2\"", "accessors[9] ends outside its view"},
      {"/accessors/9/bufferView", "0", "accessors[9] has keyframes whose times do not rise\n  got 0 behind 0 as number 1"},
  });
}

TEST(gltf_fault, of_an_index_just_behind_the_last_is_told) {
  const auto with_bytes = [](int accessor, const std::vector<std::uint8_t>& values) {
    File file = everything_file();
    file.json["accessors"][static_cast<std::size_t>(accessor)]["bufferView"] = file.view(bytes_of(values));
    return file.glb();
  };
  expect_fault(with_bytes(Everything::indices, {0, 1, 3}),
               "accessors[6] has an index that is none of the vertices of meshes[0].primitives[0]\n  got 3, and there are 3");
  expect_fault(with_bytes(Everything::joints, {0, 0, 0, 0, 0, 2, 0, 0, 0, 0, 0, 0}),
               "nodes[0].skin has fewer joints than its mesh names\n  meshes[0] names joint 2, and there are 2");
  for (const char* list : {"accessors", "bufferViews", "nodes"}) {
    File file = everything_file();
    const std::size_t size = file.json[list].size();
    file.json["skins"][0]["inverseBindMatrices"] = std::string(list) == "accessors" ? size : 8;
    file.json["accessors"][0]["bufferView"] = std::string(list) == "bufferViews" ? size : 0;
    file.json["nodes"][1]["children"] = {std::string(list) == "nodes" ? size : 2};
    expect_fault(file.glb(), std::string("is none of the ") + list + "\n  got " + std::to_string(size));
  }
}

TEST(gltf_fault, of_numbers_in_buffers_is_told) {
  const auto with_floats = [](int accessor, const std::vector<float>& values) {
    File file = everything_file();
    file.json["accessors"][static_cast<std::size_t>(accessor)]["bufferView"] = file.view(bytes_of(values));
    return file.glb();
  };
  const float nan = std::nanf(""), infinite = HUGE_VALF;
  for (const auto& times : {std::vector<float>{1, 1}, {1, 0}, {0, -0.0F}})
    expect_fault(with_floats(Everything::times, times), "accessors[9] has keyframes whose times do not rise");
  for (const auto& times : {std::vector<float>{0, nan}, {nan, 1}, {0, infinite}, {-infinite, 0}})
    expect_fault(with_floats(Everything::times, times), "accessors[9] has numbers that are not finite");
  expect_fault(with_floats(Everything::shifts, {0, 0, 0, 0, nan, 0}),
               "accessors[10] has numbers that are not finite\n  got nan in element 1");
  expect_fault(with_floats(Everything::turns, {0, 0, 0, 1, 0, 0, 0, 0}),
               "animations[0].samplers[1].output has no rotation at a keyframe\n  got a quaternion of length 0 at number 1");
  expect_fault(with_floats(Everything::turns, {0, 0, 0, 3e38F, 0, 0, 0, 1}), "has no rotation at a keyframe");
  expect_fault(with_floats(Everything::morphs, {0, 0, 0, 0, infinite, 0}), "accessors[12] has numbers that are not finite");
  std::vector<float> matrices(32, 0);
  expect_fault(with_floats(Everything::matrices, matrices), "skins[0].inverseBindMatrices has a matrix whose last row is not 0 0 0 1");
  matrices[15] = nan;
  expect_fault(with_floats(Everything::matrices, matrices), "accessors[8] has numbers that are not finite");
}

TEST(gltf_fault, of_its_text_is_told_with_line_and_column) {
  const std::string good = everything_file().text();
  expect_fault(good + "x", "error: this is not JSON");
  expect_fault("{\"asset\":\n {\"version\": 2.0.0}}", "m:2:17: error: this is not JSON");
  expect_fault(R"({"asset": {"version": "2.0", "version": "2.0"}})", "m: error: key \"version\" comes twice");
  expect_fault(R"({"nodes": [], "asset": {"version": "2.0"}, "nodes": []})", "m: error: key \"nodes\" comes twice");
  expect_fault("{\"asset\": {\"version\": \"\xFF\"}}", "error: this is not JSON");
  expect_fault("{\"asset\": {\"version\": \"\xC0\x80\"}}", "error: this is not JSON");
  expect_fault(R"({"asset": {"version": "2.0"}, "nodes": [{"scale": [1e999, 1, 1]}]})", "error: a number is beyond the range of double");
  expect_fault(R"({"asset": {"version": "2.0"}, "nodes": [{"scale": [NaN, 1, 1]}]})", "error: this is not JSON");
  expect_fault(R"({"asset": {"version": "2.0"}, "nodes": [{"scale": [Infinity, 1, 1]}]})", "error: this is not JSON");
  expect_fault(R"({"asset": {"version": "2.0"}, // no comment
                "nodes": []})",
               "error: this is not JSON");
  expect_fault(R"({"asset": {"version": "2.0"}, "extras": )" + std::string(65, '[') + std::string(65, ']') + "}",
               "nested deeper than 64 levels", ErrorKind::limit);
  expect_fault(R"({"asset": {"version": "2.0"}, "extras": )" + std::string(1'000'000, '['), "nested deeper than 64 levels",
               ErrorKind::limit);
  expect_fault(R"({"asset": {"version": "2.0"}, "nodes": [{"name": ")" + std::string(1001, 'n') + "\"}]}", "nodes[0].name is too long",
               ErrorKind::limit);
  expect_fault("{\"asset\": {\"version\": \"\\u001b[2J\"}}", "got \"\\x1b[2J\": export it as glTF 2.0");
}
