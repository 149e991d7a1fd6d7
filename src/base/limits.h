// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

/// Every limit of tofray, once: the readers check against these numbers and `tofray --limits` prints them.
namespace tofray::base {

struct Limit {
  const char* name;
  std::int64_t value;
  const char* what;
};

namespace limit {
inline constexpr Limit file_bytes{"file_bytes", 16 << 20, "bytes of one scene, profile or table file, aliases written out"};
inline constexpr Limit nesting_depth{"nesting_depth", 64, "lists and maps inside each other in one file"};
inline constexpr Limit nodes{"nodes", 400'000, "values of one file, anchors and aliases (*name) written out"};
inline constexpr Limit text_bytes{"text_bytes", 1000, "bytes of one name or other text in a file"};
inline constexpr Limit overrides{"overrides", 1000, "keys that a scene's camera or --set changes"};
inline constexpr Limit faults_shown{"faults_shown", 50, "faults printed for one file; the others are counted"};
inline constexpr Limit faults_counted{"faults_counted", 200, "faults after which a file is not read to its end"};
inline constexpr Limit message_line_bytes{"message_line_bytes", 1000, "bytes of one line of an error; a longer one is cut in its middle"};
inline constexpr Limit message_bytes{"message_bytes", 16 << 10, "bytes of one error"};
inline constexpr Limit keyframes{"keyframes", 100'000, "keyframes of one object, or of the camera"};
inline constexpr Limit objects{"objects", 20'000, "objects of one scene"};
inline constexpr Limit moving_views{
    "moving_views", 1 << 24,
    "times of a frame at which something that moves (all, where the camera does) is seen, by camera, lights and sun"};
inline constexpr Limit changing_triangles{"changing_triangles", 20'000'000,
                                          "triangles of meshes that change their shape, at all times of a frame together"};
inline constexpr Limit materials{"materials", 10'000, "materials of one scene"};
inline constexpr Limit lights{"lights", 64, "light sources of one camera; each LED of a ring and each point of an area is one"};
inline constexpr Limit light_samples{"light_samples", 8 << 20, "samples of their patterns, all together"};
inline constexpr Limit raw_frames{"raw_frames", 64, "raw frames of one mode's sequence"};
inline constexpr Limit modes{"modes", 256, "modes of one camera profile"};
inline constexpr Limit sensor_side{"sensor_side", 16'384, "pixels along one side of the sensor"};
inline constexpr Limit sensor_pixels{"sensor_pixels", 1 << 24, "pixels of the sensor"};
inline constexpr Limit subpixel_rays{"subpixel_rays", 1 << 26, "pixels times samples within each"};
inline constexpr Limit path_surfaces{"path_surfaces", std::int64_t{1} << 34,
                                     "pixels times light paths for each times surfaces that each may meet beyond the first"};
inline constexpr Limit light_values{
    "light_values", 1 << 29, "values of the images of light: pixels times what is kept of the light of each, at all times of a frame"};
inline constexpr Limit transient_values{"transient_values", 1 << 28,
                                        "values of all histograms of light by the length of its path: pixels times bins"};
inline constexpr Limit mask_side{"mask_side", 1024, "rows, or columns, of a pixel's mask"};
inline constexpr Limit kernel_side{"kernel_side", 255, "rows, or columns, of the kernel of a lens that scatters light"};
inline constexpr Limit raw_samples{"raw_samples", 1 << 27, "pixels times raw frames of one frame"};
inline constexpr Limit curve_points{"curve_points", 10'000, "points of one curve or spectrum"};
inline constexpr Limit threads{"threads", 1024, "threads of one run"};
inline constexpr Limit table_samples{"table_samples", 1 << 20, "samples of one light pattern"};
inline constexpr Limit unpacked_bytes{"unpacked_bytes", 64 << 20, "bytes that any data file may unpack to"};
inline constexpr Limit unpacked_ratio{"unpacked_ratio", 100, "times its own size that a larger data file may unpack to"};
inline constexpr Limit mesh_bytes{"mesh_bytes", 1 << 30, "bytes of one file of a triangle mesh"};
inline constexpr Limit mesh_vertices{"mesh_vertices", 20'000'000, "vertices of one triangle mesh, and of all that a scene's files hold"};
inline constexpr Limit mesh_triangles{"mesh_triangles", 20'000'000,
                                      "triangles of one triangle mesh, and of all that a scene's files hold, polygons divided"};
inline constexpr Limit mtl_files{"mtl_files", 100, "files of materials (MTL) that one OBJ file names"};
inline constexpr Limit mtl_bytes{"mtl_bytes", 16 << 20, "bytes of all MTL files of one OBJ file"};
inline constexpr Limit mtl_materials{"mtl_materials", 100'000, "materials in them, and as many names that the OBJ file uses"};
inline constexpr Limit mtl_image_bytes{"mtl_image_bytes", 256 << 20, "bytes of all images of one OBJ file, as they are encoded"};
inline constexpr Limit gltf_json_bytes{"gltf_json_bytes", 256 << 20, "bytes of a glTF file's JSON, data URIs in it counted"};
inline constexpr Limit gltf_json_values{"gltf_json_values", 4'000'000, "values of a glTF file's JSON"};
inline constexpr Limit gltf_nodes{"gltf_nodes", 100'000, "nodes of one glTF file"};
inline constexpr Limit gltf_items{"gltf_items", 500'000, "meshes of one glTF file, and as many accessors, textures, animations, …"};
inline constexpr Limit gltf_depth{"gltf_depth", 256, "nodes below each other in one glTF file"};
inline constexpr Limit gltf_parts{"gltf_parts", 200'000, "primitives of all nodes of one glTF file"};
inline constexpr Limit gltf_morphs{"gltf_morphs", 50'000'000, "morph targets times vertices of all nodes of one glTF file"};
inline constexpr Limit gltf_keyframes{"gltf_keyframes", 10'000'000, "keyframes of all samplers of one glTF file"};
inline constexpr Limit gltf_image_bytes{"gltf_image_bytes", 256 << 20, "bytes of all images of one glTF file, as they are encoded"};
inline constexpr Limit gltf_number_bytes{"gltf_number_bytes", 256 << 20, "bytes that the numbers of any glTF file may take"};
inline constexpr Limit gltf_number_ratio{"gltf_number_ratio", 8,
                                         "times the bytes of its buffers that the numbers of a larger one may take"};
// Images: what graphics cards take as textures (a side), the largest that tools write (8192 by 8192) in any shape; 16-bit RGBA of it is
// 512 MiB in memory.
inline constexpr Limit image_bytes{"image_bytes", 256 << 20, "bytes of one image file (PNG, JPEG)"};
inline constexpr Limit image_side{"image_side", 16'384, "pixels along one side of an image file"};
inline constexpr Limit image_pixels{"image_pixels", 1 << 26, "pixels of an image file"};
inline constexpr Limit map_pixels{"map_pixels", 1 << 26, "pixels of all pictures that a scene's meshes wear, once for each material"};
inline constexpr Limit image_scans{"image_scans", 100, "scans of one JPEG file, each of which may go through all pixels"};
inline constexpr Limit sweep_cells{"sweep_cells", 100'000, "cells of one sweep: the combinations of all values"};
}  // namespace limit

/// All of them, in the order in which they are printed.
inline constexpr Limit all_limits[] = {
    limit::file_bytes,
    limit::nesting_depth,
    limit::nodes,
    limit::text_bytes,
    limit::overrides,
    limit::faults_shown,
    limit::faults_counted,
    limit::message_line_bytes,
    limit::message_bytes,
    limit::keyframes,
    limit::objects,
    limit::moving_views,
    limit::changing_triangles,
    limit::materials,
    limit::lights,
    limit::light_samples,
    limit::raw_frames,
    limit::modes,
    limit::sensor_side,
    limit::sensor_pixels,
    limit::subpixel_rays,
    limit::path_surfaces,
    limit::light_values,
    limit::transient_values,
    limit::mask_side,
    limit::kernel_side,
    limit::raw_samples,
    limit::curve_points,
    limit::table_samples,
    limit::unpacked_bytes,
    limit::unpacked_ratio,
    limit::mesh_bytes,
    limit::mesh_vertices,
    limit::mesh_triangles,
    limit::mtl_files,
    limit::mtl_bytes,
    limit::mtl_materials,
    limit::mtl_image_bytes,
    limit::gltf_json_bytes,
    limit::gltf_json_values,
    limit::gltf_nodes,
    limit::gltf_items,
    limit::gltf_depth,
    limit::gltf_parts,
    limit::gltf_morphs,
    limit::gltf_keyframes,
    limit::gltf_image_bytes,
    limit::gltf_number_bytes,
    limit::gltf_number_ratio,
    limit::image_bytes,
    limit::image_side,
    limit::image_pixels,
    limit::map_pixels,
    limit::image_scans,
    limit::sweep_cells,
    limit::threads,
};

}  // namespace tofray::base
