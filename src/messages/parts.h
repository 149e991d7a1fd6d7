// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "messages/cdr.h"
#include "messages/topics.h"
#include "tofray/frame.h"
#include "tofray/scene.h"

/// The messages by themselves: each function writes one into `out`, whose memory is used again.
namespace tofray::messages {

struct Size {
  int width, height;
  [[nodiscard]] std::size_t pixels() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
};

/// What an image shows, without its pixels.
struct ImageForm {
  Header header;
  Size size;
  const char* encoding;
  std::size_t bytes_per_pixel;
};
/// sensor_msgs/Image. @return where its pixels go
char* put_image(std::string& out, const ImageForm& form);

/// z or range [m] as 32FC1 (the same bits) or as 16UC1: whole millimetres, 0 where there is no number or more than 65535 of them.
void put_depth(std::string& out, const Header& header, Size size, const std::vector<float>& depth_m, bool millimetres);
/// Amplitude over its step, rounded and clipped to 0…65535; of mono8 that number / 256. No number: 0.
std::uint16_t amplitude_code(float amplitude_e, double step_e);
void put_amplitude(std::string& out, const Header& header, Size size, const std::vector<float>& amplitude_e, double step_e,
                   bool eight_bits);
/// Numbers as they are, under an encoding of their size.
template <class T>
void put_plain(std::string& out, const Header& header, Size size, const T* values, const char* encoding) {
  std::memcpy(put_image(out, {header, size, encoding, sizeof(T)}), values, size.pixels() * sizeof(T));
}

/// sensor_msgs/CameraInfo. @param rational  eight numbers of distortion, also where five would do
void put_camera_info(std::string& out, const Header& header, Size size, const Lens& lens, bool rational);
/// The pinhole that rectified images have: the same focal lengths, principal point and size, no distortion.
Lens pinhole_of(const Lens& lens);
/// For each pixel of that pinhole the pixel of the image that lies nearest, −1 where the lens sees nothing there.
std::vector<std::int32_t> nearest_pixels(const Lens& lens, Size size);

/// sensor_msgs/PointCloud2.
struct CloudForm {
  const std::vector<CloudField>& fields;
  std::uint32_t point_step;
  double amplitude_step_e;
  bool unorganized;
};
void put_cloud(std::string& out, const Header& header, const Depth& depth, const CloudForm& form);

/// A frame of coordinates within another one: where its zero is [m], and by which quaternion x, y, z, w it is turned.
struct Stand {
  std::array<double, 3> position{};
  std::array<double, 4> rotation{0, 0, 0, 1};
};
/// x forward, y left, z up → x right, y down, z forward: how an optical frame stands in its link (REP 103).
Stand optical_in_link();
/// Where the link is on the map, whose z is up, when the camera's optical frame is at `pose` in the world.
Stand link_on_map(const std::array<double, 16>& pose, Scene::Up world_up);

struct NamedStand {
  std::string parent, child;
  Stand stand;
};
/// tf2_msgs/TFMessage.
void put_transforms(std::string& out, std::int64_t stamp_ns, const std::vector<NamedStand>& all);

}  // namespace tofray::messages
