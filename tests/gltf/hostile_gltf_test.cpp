// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// One fault each in a file that has all that is read, and what the error says of it.
#include "everything.h"

using namespace tofray;
using namespace tofray::gltf_test;

namespace {

/// What is changed where (nothing: it is taken out), and the error's first line behind "m: error: ".
struct Fault {
  const char* at;
  const char* value;
  const char* message;
};

std::string with(const std::string& at, const std::string& value) {
  Document json = everything_file().with_buffer("");
  const Document::json_pointer pointer(at);
  if (value.empty())
    json[pointer.parent_pointer()].erase(pointer.back());
  else
    json[pointer] = Document::parse(value);
  File file = everything_file();
  file.json = json;
  return file.glb();
}

/// "accessors[0].count" of "/accessors/0/count".
std::string place_of(const std::string& pointer) {
  std::string out;
  for (std::size_t from = 1; from < pointer.size();) {
    const std::size_t end = std::min(pointer.find('/', from), pointer.size());
    const std::string part = pointer.substr(from, end - from);
    const bool index = part.find_first_not_of("0123456789") == std::string::npos;
    out += index ? "[" + part + "]" : (out.empty() ? "" : ".") + part;
    from = end + 1;
  }
  return out;
}

std::size_t expect_each(const std::vector<Fault>& faults) {
  for (const Fault& fault : faults) {
    SCOPED_TRACE(std::string(fault.at) + " = " + fault.value);
    const std::string message = message_of(with(fault.at, fault.value));
    EXPECT_EQ(message.rfind("m: error: " + std::string(fault.message), 0), 0U) << message << "\nexpected: " << fault.message;
  }
  return faults.size();
}

/// Each of these values at each of these places, refused as not being `kind`.
std::size_t expect_kind(const std::vector<const char*>& places, const std::vector<const char*>& values, const std::string& kind) {
  for (const char* at : places)
    for (const char* value : values) {
      const std::string expected = "m: error: " + place_of(at) + " is not " + kind, message = message_of(with(at, value));
      EXPECT_EQ(message.rfind(expected, 0), 0U) << at << " = " << value << "\n" << message << "\nexpected: " << expected;
    }
  return places.size() * values.size();
}

std::size_t faults_seen = 0;

}  // namespace

TEST(gltf_fault, there_is_none_in_the_file_that_all_faults_are_put_into) {
  const Model model = model_of(everything_file());
  EXPECT_EQ(model.notices, std::vector<std::string>{"light that materials emit is left out"});
  // The target lifts the corners by 0.25, the last by 3 · 0.25 in each direction; the skin is at rest.
  EXPECT_EQ(parts_at_rest(model).at(0).mesh.vertices, (Vertices{{0, 0, 0.25F}, {1, 0, 0.25F}, {0.75F, 1.75F, 0.75F}}));
  EXPECT_NE(parts_at(model, 0.5).at(0).mesh.vertices[0], parts_at_rest(model).at(0).mesh.vertices[0]);
}

TEST(gltf_fault, of_a_kind_is_told_with_its_place) {
  const std::vector<const char*> no_whole = {"-1", "1.5", "\"1\"", "null", "true", "[]", "{}", "1e308", "-1e308", "9007199254740994",
                                             "[1]"};
  faults_seen += expect_kind({"/accessors/0/count",
                              "/accessors/0/byteOffset",
                              "/accessors/0/bufferView",
                              "/accessors/0/componentType",
                              "/buffers/0/byteLength",
                              "/bufferViews/0/buffer",
                              "/bufferViews/0/byteOffset",
                              "/bufferViews/0/byteLength",
                              "/bufferViews/0/byteStride",
                              "/scene",
                              "/meshes/0/primitives/0/mode",
                              "/meshes/0/primitives/0/indices",
                              "/meshes/0/primitives/0/material",
                              "/meshes/0/primitives/0/attributes/POSITION",
                              "/meshes/0/primitives/0/attributes/JOINTS_0",
                              "/meshes/0/primitives/0/targets/0/POSITION",
                              "/nodes/0/mesh",
                              "/nodes/0/skin",
                              "/nodes/3/camera",
                              "/nodes/1/children/0",
                              "/skins/0/joints/0",
                              "/skins/0/skeleton",
                              "/skins/0/inverseBindMatrices",
                              "/scenes/0/nodes/2",
                              "/animations/0/channels/0/sampler",
                              "/animations/0/channels/0/target/node",
                              "/animations/0/samplers/0/input",
                              "/animations/0/samplers/0/output",
                              "/accessors/7/sparse/count",
                              "/accessors/7/sparse/indices/bufferView",
                              "/accessors/7/sparse/values/byteOffset",
                              "/materials/0/normalTexture/index",
                              "/materials/0/pbrMetallicRoughness/baseColorTexture/texCoord",
                              "/textures/0/source",
                              "/textures/0/sampler",
                              "/samplers/0/wrapS",
                              "/images/0/bufferView"},
                             no_whole, "a whole number from 0 to 2^53");
  faults_seen +=
      expect_kind({"/materials/0/alphaCutoff", "/materials/0/pbrMetallicRoughness/metallicFactor", "/materials/0/normalTexture/scale",
                   "/cameras/0/perspective/yfov", "/cameras/0/perspective/zfar", "/cameras/1/orthographic/xmag",
                   "/materials/0/extras/nir_reflectivity", "/nodes/1/scale/0", "/nodes/3/matrix/15", "/meshes/0/weights/0"},
                  {"\"1\"", "null", "true", "[]", "{}"}, "a number");
  faults_seen += expect_kind({"/nodes",
                              "/meshes",
                              "/accessors",
                              "/bufferViews",
                              "/buffers",
                              "/scenes",
                              "/nodes/1/children",
                              "/skins/0/joints",
                              "/nodes/1/translation",
                              "/nodes/3/matrix",
                              "/animations",
                              "/animations/0/channels",
                              "/meshes/0/primitives",
                              "/extensionsUsed",
                              "/extensionsRequired",
                              "/materials",
                              "/textures",
                              "/images",
                              "/samplers",
                              "/cameras"},
                             {"{}", "1", "\"a\"", "null"}, "a list");
  faults_seen +=
      expect_kind({"/asset", "/nodes/0", "/meshes/0", "/meshes/0/primitives/0", "/meshes/0/primitives/0/attributes", "/accessors/0",
                   "/accessors/7/sparse", "/accessors/7/sparse/indices", "/accessors/7/sparse/values", "/animations/0",
                   "/animations/0/channels/0/target", "/materials/0/pbrMetallicRoughness", "/cameras/0/perspective",
                   "/materials/0/normalTexture/extensions/KHR_texture_transform", "/scenes/0", "/skins/0"},
                  {"[]", "1", "\"a\"", "null"}, "an object");
  faults_seen += expect_kind({"/asset/version", "/nodes/0/name", "/accessors/0/type", "/cameras/0/type", "/materials/0/alphaMode",
                              "/animations/0/samplers/0/interpolation", "/animations/0/channels/0/target/path", "/images/0/mimeType",
                              "/extensionsUsed/0", "/buffers/0/uri"},
                             {"[]", "1", "{}", "null"}, "a string");
  faults_seen += expect_kind({"/accessors/0/normalized", "/materials/0/doubleSided"}, {"[]", "1", "\"true\"", "null"}, "true or false");
}

TEST(gltf_fault, of_what_is_missing_is_told_with_its_place) {
  const std::vector<const char*> needed = {"/asset",
                                           "/asset/version",
                                           "/buffers/0/byteLength",
                                           "/bufferViews/0/buffer",
                                           "/bufferViews/0/byteLength",
                                           "/accessors/0/componentType",
                                           "/accessors/0/type",
                                           "/accessors/0/count",
                                           "/accessors/7/sparse/count",
                                           "/accessors/7/sparse/indices",
                                           "/accessors/7/sparse/values",
                                           "/accessors/7/sparse/indices/bufferView",
                                           "/accessors/7/sparse/indices/componentType",
                                           "/accessors/7/sparse/values/bufferView",
                                           "/meshes/0/primitives/0/attributes",
                                           "/cameras/0/type",
                                           "/cameras/0/perspective",
                                           "/cameras/0/perspective/yfov",
                                           "/cameras/0/perspective/znear",
                                           "/cameras/1/orthographic",
                                           "/cameras/1/orthographic/xmag",
                                           "/cameras/1/orthographic/ymag",
                                           "/cameras/1/orthographic/znear",
                                           "/cameras/1/orthographic/zfar",
                                           "/animations/0/channels/0/sampler",
                                           "/animations/0/channels/0/target",
                                           "/animations/0/channels/0/target/path",
                                           "/animations/0/samplers/0/input",
                                           "/animations/0/samplers/0/output",
                                           "/materials/0/normalTexture/index"};
  for (const char* at : needed) {
    const std::string message = message_of(with(at, ""));
    EXPECT_EQ(message.rfind("m: error: " + place_of(at) + " is missing\n  expected ", 0), 0U) << message;
  }
  faults_seen += needed.size();
}

TEST(gltf_fault, of_an_index_is_told_with_its_place) {
  const std::vector<std::pair<const char*, const char*>> indices = {{"/scene", "scenes"},
                                                                    {"/scenes/0/nodes/0", "nodes"},
                                                                    {"/nodes/0/mesh", "meshes"},
                                                                    {"/nodes/0/skin", "skins"},
                                                                    {"/nodes/3/camera", "cameras"},
                                                                    {"/nodes/1/children/0", "nodes"},
                                                                    {"/skins/0/joints/1", "nodes"},
                                                                    {"/skins/0/skeleton", "nodes"},
                                                                    {"/skins/0/inverseBindMatrices", "accessors"},
                                                                    {"/meshes/0/primitives/0/material", "materials"},
                                                                    {"/meshes/0/primitives/0/indices", "accessors"},
                                                                    {"/meshes/0/primitives/0/attributes/POSITION", "accessors"},
                                                                    {"/meshes/0/primitives/0/attributes/NORMAL", "accessors"},
                                                                    {"/meshes/0/primitives/0/targets/0/POSITION", "accessors"},
                                                                    {"/accessors/0/bufferView", "bufferViews"},
                                                                    {"/accessors/7/sparse/indices/bufferView", "bufferViews"},
                                                                    {"/accessors/7/sparse/values/bufferView", "bufferViews"},
                                                                    {"/bufferViews/0/buffer", "buffers"},
                                                                    {"/textures/0/source", "images"},
                                                                    {"/textures/0/sampler", "samplers"},
                                                                    {"/images/0/bufferView", "bufferViews"},
                                                                    {"/materials/0/normalTexture/index", "textures"},
                                                                    {"/animations/0/channels/0/sampler", "samplers"},
                                                                    {"/animations/0/channels/0/target/node", "nodes"},
                                                                    {"/animations/0/samplers/0/input", "accessors"},
                                                                    {"/animations/0/samplers/0/output", "accessors"}};
  for (const auto& [at, things] : indices)
    for (const char* value : {"99", "4294967296", "9007199254740992"}) {
      const std::string message = message_of(with(at, value));
      EXPECT_EQ(message.rfind("m: error: " + place_of(at) + " is none of the " + things, 0), 0U) << message;
    }
  faults_seen += 3 * indices.size();
}

TEST(gltf_fault, of_a_version_view_or_accessor_is_told) {
  faults_seen += expect_each({
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
  faults_seen += expect_each({
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
      {"/bufferViews/6/byteOffset", "0",
       "accessors[6] has an index that is none of the vertices of meshes[0].primitives[0]\n  got 128, and there are 3"},
  });
}

TEST(gltf_fault, of_a_node_scene_skin_or_camera_is_told) {
  faults_seen += expect_each({
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
      {"/cameras/0/perspective/yfov", "4", "cameras[0].perspective.yfov is out of range"},
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
  faults_seen += expect_each({
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
  faults_seen += expect_each({
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
  faults_seen += 12;
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
  faults_seen += 14;
}

TEST(gltf_fault, many_were_seen) {
  if (testing::GTEST_FLAG(filter) == "*") EXPECT_GE(faults_seen, 300U);
}
