// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tofray/camera.h"
#include "tofray/scene.h"
#include "tofray/stages.h"

/// Pictures that a renderer or a robot's simulator drew, as a Geometry for the camera's own rays.
namespace tofray {

/// A camera without distortion, as renderers have it: what is at (x, y, z) before it is seen at (fx·x/z + cx, fy·y/z + cy).
struct Pinhole {
  int width = 0, height = 0;  ///< size of the picture in pixels; row 0 is the topmost
  double fx_px = 0, fy_px = 0, cx_px = 0, cy_px = 0;
  /// Where the middle of the first pixel is: 0.5 where numbers count from the picture's corner, as OpenGL, Blender, Open3D and most simulators
  /// have it; 0 where they count from that middle, as OpenCV, ROS and tofray's lenses do [px].
  double pixel_centre = 0.5;
};

/// The picture to ask a renderer for: it covers all of the camera's rays, its middle is the optical axis and its pixels are square, which every
/// renderer can draw. Its angle of view upwards and downwards is 2·atan(height/(2·fy)).
/// @param margin_px   pixels beyond the outermost rays, on each side
/// @param oversample  of its pixels for one of the camera's, along rows and columns, on the axis
/// @throws Error as a Simulator's constructor does for this camera; (bad_input) for numbers out of range; (limit) for a camera that sees so
/// far off its axis that the picture is too large
Pinhole pinhole_for(const Camera& camera, double margin_px = 2, double oversample = 2, double pixel_centre = 0.5);

/// What a surface with this label sends back.
struct LabelMaterial {
  std::int32_t label = 0;
  Material material;  ///< lambert or phong; load_material() knows some by name
};

/// What a renderer drew through a pinhole: plain arrays, row-major, which stay the caller's. Empty: there is none.
struct RenderedPictures {
  Pinhole pinhole;
  int moments = 1;             ///< 1, or one for each raw frame: see exposure_times()
  bool still = false;          ///< nothing moves within a frame: one moment is all that there is, and no notice says that it lacks others
  std::span<const float> z_m;  ///< [moment][height][width] along the optical axis; not above 0, or no number: nothing is seen
  bool along_ray = false;      ///< z_m is along each pixel's ray: the range
  /// Nothing is seen from here on, less 0.1 %: the renderer's far plane, 65.535 of whole millimetres in 16 bits.
  double background_m = std::numeric_limits<double>::infinity();
  std::span<const float> normal;  ///< [moment][height][width][3]; empty, or no number, or 0: made of z (theory 6.7)
  /// Rows of the rotation from the normals' axes to the camera's, x right, y down, z forward.
  std::array<double, 9> normal_axes{1, 0, 0, 0, 1, 0, 0, 0, 1};
  std::span<const std::int32_t> labels;         ///< [moment][height][width] also for Truth::object_id
  std::vector<LabelMaterial> materials;         ///< what the labels say counts more than pictures
  std::span<const float> reflectivity;          ///< [moment][height][width] 0…1, at the illumination wavelength
  std::span<const float> colour;                ///< [moment][height][width][3] 0…1, linear: its mean stands for reflectivity
  std::span<const std::uint8_t> screen_colour;  ///< [moment][height][width][3] the same as screens take it (sRGB), which is decoded
  std::optional<double> other_reflectivity;     ///< reflectivity of what neither labels nor pictures say
};

/// Pictures as the camera's rays see them.
struct SampledPictures {
  Geometry geometry;
  double outside = 0;                ///< share of the rays that look past the picture, where nothing is seen
  std::vector<std::string> notices;  ///< sentences: what stands for what, and what is odd
};

/// Looks along each of the camera's rays (pixel_rays(), lens and readout and all) into the pictures: of the nearest pixel its normal, label
/// and reflectivity, and z of the plane through it with that normal (theory 6.7). Nothing is a mean of several pixels: between a near and a far
/// surface there is none. To 0.1 mm of z where surfaces are larger than pixels and normals are the surface's.
///
/// Against a scene of tofray's own there are no bounces, no shadow of the camera's light beside the lens, and no pixels that an edge crosses
/// (SimulatorOptions::subpixel).
/// @throws Error (bad_input) for arrays of another size, numbers out of range, a seen surface of unknown reflectivity, and materials that a
/// Geometry cannot say
SampledPictures from_pictures(const Camera& camera, const RenderedPictures& pictures);

}  // namespace tofray
