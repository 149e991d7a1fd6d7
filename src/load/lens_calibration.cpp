// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "load/lens_calibration.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <initializer_list>
#include <vector>

#include "base/text.h"

namespace tofray::load {

namespace {

using base::fail;
using yaml::Node;

/// What is no YAML of ours in the files of OpenCV and ROS: directive, tags, a document behind the first. Lines and columns stay.
std::string as_plain_yaml(std::string text) {
  while (!text.empty() && text.back() == '\0') text.pop_back();  // an Azure Kinect ends its text by one
  if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
  for (const char* tag : {"!!opencv-nd-matrix", "!!opencv-matrix"})
    for (std::size_t at = text.find(tag); at != std::string::npos; at = text.find(tag, at))
      text.replace(at, std::string(tag).size(), std::string(tag).size(), ' ');
  bool begun = false;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string line = text.substr(at, end - at);
    if (line.starts_with("---") && begun) {
      text.resize(at);
      break;
    }
    if (line.starts_with("%YAML") || line.starts_with("---")) {
      text.replace(at, line.size(), line.size(), ' ');
    } else if (line.find_first_not_of(" \t\r") != std::string::npos && !line.starts_with("#")) {
      begun = true;
    }
    at = end + 1;
  }
  return text;
}

void refuse_other_formats(const std::string& text, const std::string& source) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  const std::string_view begin = first == std::string::npos ? std::string_view() : std::string_view(text).substr(first);
  if (begin.starts_with("<"))
    fail(base::whole(source), "this is XML", "expected YAML or JSON: cv::FileStorage writes it into a file whose name ends in .yml");
  if (begin.starts_with("PK") || begin.starts_with("\x93NUMPY"))
    fail(base::whole(source), "this is an array file of numpy",
         "expected YAML or JSON: cv2.FileStorage(\"camera.yml\", cv2.FILE_STORAGE_WRITE) writes camera_matrix and distortion_coefficients");
}

double number_of(const Node& node) {
  char* end = nullptr;
  const double value = node.kind == Node::Kind::scalar ? std::strtod(node.text.c_str(), &end) : std::nan("");
  if (node.kind != Node::Kind::scalar || end == node.text.c_str() || *end != '\0' || !std::isfinite(value))
    fail(node.place, "this is no number", "got " + yaml::describe(node) + ", expected one");
  return value;
}

/// A matrix of OpenCV's or ROS's (`rows`, `cols`, `data`), or a list, or a list of rows.
std::vector<double> numbers_of(const Node& node) {
  const Node* data = node.kind == Node::Kind::map ? node.find("data") : &node;
  if (data == nullptr || data->kind != Node::Kind::list)
    fail(node.place, "this is no matrix", "got " + yaml::describe(node) + ", expected rows, cols and data, or a list of numbers");
  std::vector<double> out;
  for (const Node& one : data->items) {
    if (one.kind == Node::Kind::list)
      for (const Node& inner : one.items) out.push_back(number_of(inner));
    else
      out.push_back(number_of(one));
  }
  return out;
}

const Node* first_of(const Node& root, std::initializer_list<const char*> names) {
  for (const char* name : names)
    if (const Node* found = root.find(name)) return found;
  return nullptr;
}

int pixels_of(const Node& node, double value) {
  if (value != std::rint(value) || value < 1 || value > 65536)
    fail(node.place, "this is no size of an image", "got " + base::number_text(value) + ", expected a whole number from 1 to 65536");
  return static_cast<int>(value);
}

std::optional<int> whole_of(const Node& root, std::initializer_list<const char*> names) {
  const Node* node = first_of(root, names);
  if (node == nullptr) return {};
  return pixels_of(*node, number_of(*node));
}

std::optional<PixelGrid> size_of(const Node& root) {
  const auto width = whole_of(root, {"image_width", "image_Width", "imageWidth", "width"});
  const auto height = whole_of(root, {"image_height", "image_Height", "imageHeight", "height"});
  if (width && height) return PixelGrid{*width, *height};
  const Node* both = first_of(root, {"image_size", "imageSize", "img_size", "resolution"});
  if (both == nullptr) return {};
  const std::vector<double> numbers = numbers_of(*both);
  if (numbers.size() != 2) fail(both->place, "this is no size of an image", "got " + yaml::describe(*both) + ", expected [width, height]");
  return PixelGrid{pixels_of(*both, numbers[0]), pixels_of(*both, numbers[1])};
}

std::string size_text(const PixelGrid& size) { return std::to_string(size.width) + " x " + std::to_string(size.height); }

void take_matrix(const Node& node, Lens& lens) {
  const std::vector<double> k = numbers_of(node);
  if (k.size() != 9) fail(node.place, "the camera matrix is not 3 x 3", "got " + std::to_string(k.size()) + " numbers, expected 9");
  if (k[1] != 0)
    fail(node.place, "the camera matrix has a skew of " + base::number_text(k[1]) + " px",
         "expected 0 beside fx: rows and columns of tofray's pixels are square to each other");
  if (k[3] != 0 || k[6] != 0 || k[7] != 0 || k[8] != 1 || !(k[0] > 0) || !(k[4] > 0))
    fail(node.place, "this is no camera matrix", "expected [fx, 0, cx, 0, fy, cy, 0, 0, 1] with fx and fy above 0");
  lens.fx_px = k[0], lens.fy_px = k[4], lens.cx_px = k[2], lens.cy_px = k[5];
}

bool any_of(const std::vector<double>& d, std::size_t from, std::size_t to) {
  return std::any_of(d.begin() + static_cast<std::ptrdiff_t>(std::min(from, d.size())),
                     d.begin() + static_cast<std::ptrdiff_t>(std::min(to, d.size())), [](double value) { return value != 0; });
}

/// OpenCV's order: k1 k2 p1 p2 k3 k4 k5 k6 s1 s2 s3 s4 τx τy; of its fisheye model k1 k2 k3 k4.
void take_distortion(const Node& node, bool fisheye, Lens& lens) {
  std::vector<double> d = numbers_of(node);
  const std::string count = "got " + std::to_string(d.size()) + " coefficients, expected ";
  if (fisheye) {
    if (!d.empty() && d.size() != 4) fail(node.place, "a fisheye lens has four coefficients of distortion", count + "k1, k2, k3, k4");
    d.resize(4);
    lens.distortion = Lens::Distortion::fisheye;
    lens.k1 = d[0], lens.k2 = d[1], lens.k3 = d[2], lens.k4 = d[3];
    return;
  }
  constexpr std::array<std::size_t, 6> known = {0, 4, 5, 8, 12, 14};
  if (std::find(known.begin(), known.end(), d.size()) == known.end())
    fail(node.place, "no model of OpenCV has so many coefficients of distortion",
         count + "4, 5, 8, 12 or 14: k1, k2, p1, p2, k3, k4, k5, k6, …");
  if (any_of(d, 8, 12))
    fail(node.place, "tofray's lens has no thin prism (s1, s2, s3, s4)",
         "calibrate without CALIB_THIN_PRISM_MODEL: with k1 to k6, p1 and p2");
  if (any_of(d, 12, 14))
    fail(node.place, "tofray's lens has no tilted sensor (tau_x, tau_y)", "calibrate without CALIB_TILTED_MODEL: with k1 to k6, p1 and p2");
  d.resize(14);
  lens.k1 = d[0], lens.k2 = d[1], lens.p1 = d[2], lens.p2 = d[3], lens.k3 = d[4], lens.k4 = d[5], lens.k5 = d[6], lens.k6 = d[7];
}

/// Whether the model is the fisheye one. @throws Error for one that tofray does not have
bool is_fisheye(const Node& root) {
  if (const Node* flag = root.find("fisheye_model")) return number_of(*flag) != 0;  // of OpenCV's sample
  const Node* model = root.find("distortion_model");
  if (model == nullptr || model->kind == Node::Kind::null) return false;
  const std::string& name = model->text;
  if (name == "equidistant" || name == "fisheye") return true;
  if (name == "plumb_bob" || name == "rational_polynomial" || name == "radtan" || name.empty() || name == "none") return false;
  fail(model->place, "tofray's lens has no distortion model " + base::in_quotes(name),
       "expected plumb_bob, rational_polynomial or equidistant");
}

/// A message of ROS may speak of a part of the image, or of binned pixels; its matrix is that of all pixels.
void refuse_parts(const Node& root) {
  for (const char* name : {"binning_x", "binning_y"})
    if (const Node* binning = root.find(name); binning != nullptr && number_of(*binning) > 1)
      fail(binning->place, "these images are binned",
           "expected " + std::string(name) + " 0 or 1; in tofray it is readout.binning of the profile");
  const Node* roi = root.find("roi");
  if (roi == nullptr || roi->kind != Node::Kind::map) return;
  for (const char* name : {"x_offset", "y_offset", "width", "height"})
    if (const Node* value = roi->find(name); value != nullptr && number_of(*value) != 0)
      fail(roi->place, "these images are a part of the sensor's", "expected a roi of 0; in tofray it is readout.region of the profile");
}

constexpr const char* matrix_names = "camera_matrix, cameraMatrix, K or M1";
constexpr const char* distortion_names = "distortion_coefficients, distCoeffs, D or D1";

LensCalibration of_opencv(const Node& root, const std::string& source) {
  LensCalibration out;
  if (root.find("M1") != nullptr && root.find("M2") != nullptr)
    fail(base::whole(source), "this file has two cameras, M1 with D1 and M2 with D2", "expected one: take the other's two matrices out");
  const Node* matrix =
      first_of(root, {"camera_matrix", "Camera_Matrix", "cameraMatrix", "CameraMatrix", "camera_mat", "K", "k", "M1", "M2", "mtx"});
  const Node* distortion = first_of(root, {"distortion_coefficients", "Distortion_Coefficients", "distortionCoefficients", "distCoeffs",
                                           "dist_coeffs", "dist_coeff", "dist_coefs", "DistCoeffs", "D", "d", "D1", "D2", "dist"});
  if (matrix == nullptr)
    fail(base::whole(source), "no camera matrix",
         std::string("expected ") + matrix_names + ", or an Azure Kinect's CalibrationInformation");
  if (distortion == nullptr)
    fail(base::whole(source), "no distortion", std::string("expected ") + distortion_names + "; [] for a lens that has none");
  refuse_parts(root);
  out.format = root.find("distortion_model") != nullptr ? "ROS camera_info" : "OpenCV";
  take_matrix(*matrix, out.lens);
  take_distortion(*distortion, is_fisheye(root), out.lens);
  out.size = size_of(root);
  return out;
}

/// One of the images that an Azure Kinect's depth camera makes: the whole sensor in pixels of that size, and where the image begins in it.
struct KinectImage {
  PixelGrid size;
  int whole, crop_x, crop_y;
};
constexpr KinectImage kinect_images[] = {
    {{640, 576}, 1024, 192, 180}, {{320, 288}, 512, 96, 90}, {{1024, 1024}, 1024, 0, 0}, {{512, 512}, 512, 0, 0}};

const Node& wanted_key(const Node& node, const char* name) {
  const Node* found = node.find(name);
  if (found == nullptr) fail(node.place, "no " + std::string(name), "expected it as the Azure Kinect's raw calibration has it");
  return *found;
}

LensCalibration of_kinect(const Node& information, std::optional<PixelGrid> wanted) {
  const Node& cameras = wanted_key(information, "Cameras");
  const auto is_depth = [](const Node& one) {
    const Node* location = one.find("Location");
    return location != nullptr && location->text == "CALIBRATION_CameraLocationD0";
  };
  const auto depth = std::find_if(cameras.items.begin(), cameras.items.end(), is_depth);
  if (depth == cameras.items.end())
    fail(cameras.place, "no depth camera among Cameras", "expected one whose Location is CALIBRATION_CameraLocationD0");
  const KinectImage* const image =
      wanted ? std::find_if(std::begin(kinect_images), std::end(kinect_images), [&](const auto& one) { return one.size == *wanted; })
             : std::end(kinect_images);
  if (image == std::end(kinect_images))
    fail(depth->place,
         wanted ? "an Azure Kinect's depth camera has no images of " + size_text(*wanted) + " pixels"
                : std::string("an Azure Kinect's depth camera has images of several sizes"),
         "expected --camera with a sensor of 640 x 576, 320 x 288, 1024 x 1024 or 512 x 512 pixels, such as azure-kinect-nfov");
  const Node &intrinsics = wanted_key(*depth, "Intrinsics"), &model = wanted_key(intrinsics, "ModelType");
  if (model.text != "CALIBRATION_LensDistortionModelBrownConrady")
    fail(model.place, "tofray's lens has no distortion model " + base::in_quotes(model.text),
         "expected CALIBRATION_LensDistortionModelBrownConrady");
  const Node& parameters = wanted_key(intrinsics, "ModelParameters");
  const std::vector<double> v = numbers_of(parameters);  // cx cy fx fy k1…k6 codx cody p2 p1
  if (v.size() < 14) fail(parameters.place, "too few ModelParameters", "got " + std::to_string(v.size()) + ", expected 14");
  if (v[10] != 0 || v[11] != 0)
    fail(parameters.place, "tofray's lens has no centre of distortion of its own (codx, cody)", "expected 0 for the 11th and 12th number");
  LensCalibration out;
  out.format = "Azure Kinect";
  Lens& lens = out.lens;
  lens.fx_px = v[2] * image->whole, lens.fy_px = v[3] * image->whole;
  lens.cx_px = v[0] * image->whole - image->crop_x - 0.5, lens.cy_px = v[1] * image->whole - image->crop_y - 0.5;
  lens.k1 = v[4], lens.k2 = v[5], lens.k3 = v[6], lens.k4 = v[7], lens.k5 = v[8], lens.k6 = v[9], lens.p2 = v[12], lens.p1 = v[13];
  out.size = image->size;
  return out;
}

}  // namespace

LensCalibration lens_calibration(const std::string& text, const std::string& source, std::optional<PixelGrid> wanted) {
  refuse_other_formats(text, source);
  const Node root = yaml::parse_tree(as_plain_yaml(text), source);
  const Node* kinect = root.find("CalibrationInformation");
  const LensCalibration out = kinect != nullptr ? of_kinect(*kinect, wanted) : of_opencv(root, source);
  const Lens& lens = out.lens;
  const std::optional<PixelGrid> size = out.size ? out.size : wanted;
  if (wanted && out.size && *out.size != *wanted)
    fail(base::whole(source),
         "the calibration is of images of " + size_text(*out.size) + " pixels, the camera's sensor has " + size_text(*wanted),
         "expected one size: calibrate with images of the sensor's size, or change sensor.width and sensor.height of the profile");
  if (size && !(lens.cx_px > -0.5 && lens.cx_px < size->width && lens.cy_px > -0.5 && lens.cy_px < size->height))
    fail(base::whole(source),
         "the principal point (" + base::number_text(lens.cx_px) + ", " + base::number_text(lens.cy_px) + ") px lies beside the image of " +
             size_text(*size) + " pixels",
         "expected one in it: is the calibration one of larger images?");
  return out;
}

}  // namespace tofray::load
