// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// One fault each in a file that has all that is read: values of a wrong kind, or missing, or indices of nothing.
#include "faults.h"

using namespace tofray;
using namespace tofray::gltf_test;

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
  expect_kind({"/accessors/0/count",
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
  expect_kind(
      {"/materials/0/alphaCutoff", "/materials/0/pbrMetallicRoughness/metallicFactor", "/materials/0/normalTexture/scale",
       "/cameras/0/perspective/yfov", "/cameras/0/perspective/zfar", "/cameras/1/orthographic/xmag", "/materials/0/extras/nir_reflectivity",
       "/materials/0/pbrMetallicRoughness/roughnessFactor", "/materials/0/extensions/KHR_materials_ior/ior",
       "/materials/0/extensions/KHR_materials_specular/specularFactor", "/nodes/1/scale/0", "/nodes/3/matrix/15", "/meshes/0/weights/0"},
      {"\"1\"", "null", "true", "[]", "{}"}, "a number");
  expect_kind({"/nodes",
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
  expect_kind({"/asset", "/nodes/0", "/meshes/0", "/meshes/0/primitives/0", "/meshes/0/primitives/0/attributes", "/accessors/0",
               "/accessors/7/sparse", "/accessors/7/sparse/indices", "/accessors/7/sparse/values", "/animations/0",
               "/animations/0/channels/0/target", "/materials/0/pbrMetallicRoughness", "/cameras/0/perspective",
               "/materials/0/normalTexture/extensions/KHR_texture_transform", "/scenes/0", "/skins/0"},
              {"[]", "1", "\"a\"", "null"}, "an object");
  expect_kind({"/asset/version", "/nodes/0/name", "/accessors/0/type", "/cameras/0/type", "/materials/0/alphaMode",
               "/animations/0/samplers/0/interpolation", "/animations/0/channels/0/target/path", "/images/0/mimeType", "/extensionsUsed/0",
               "/buffers/0/uri"},
              {"[]", "1", "{}", "null"}, "a string");
  expect_kind({"/accessors/0/normalized", "/materials/0/doubleSided"}, {"[]", "1", "\"true\"", "null"}, "true or false");
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
}
