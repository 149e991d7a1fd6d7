// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "io/meta.h"

#include "io/json.h"
#include "io/version.h"

namespace tofray::io {
namespace {

Json curve_json(const Curve& curve) { return Json::object().set("x", Json::list(curve.x)).set("y", Json::list(curve.y)); }

// --- units --------------------------------------------------------------------------------------------------------------------

struct ArrayUnit {
  const char* array;
  const char* unit;
};

constexpr ArrayUnit array_units[] = {{"tap_a", "e"},
                                     {"tap_b", "e"},
                                     {"raw", "DN"},
                                     {"modulation_frequency_hz", "Hz"},
                                     {"reference_phase_rad", "rad"},
                                     {"integration_time_s", "s"},
                                     {"start_time_s", "s"},
                                     {"lit", "1"},
                                     {"z_m", "m"},
                                     {"range_m", "m"},
                                     {"points_m", "m"},
                                     {"amplitude_e", "e"},
                                     {"ambient_e", "e"},
                                     {"noise_m", "m"},
                                     {"confidence", "1"},
                                     {"flags", "1"},
                                     {"gt_time_s", "s"},
                                     {"gt_range_m", "m"},
                                     {"gt_z_m", "m"},
                                     {"gt_reflectivity", "1"},
                                     {"gt_position_m", "m"},
                                     {"gt_normal", "1"},
                                     {"gt_object_id", "1"},
                                     {"gt_irradiance_w_m2", "W/m2"},
                                     {"gt_radiance_w_m2_sr", "W/(m2 sr)"},
                                     {"gt_power_w", "W"},
                                     {"gt_signal_e", "e"},
                                     {"camera_matrix", "px"},
                                     {"distortion", "1"},
                                     {"camera_pose", "m"}};

Json units_json() {
  Json units = Json::object();
  for (const ArrayUnit& entry : array_units) units.set(entry.array, entry.unit);
  return units;
}

// --- camera -------------------------------------------------------------------------------------------------------------------

Json lens_json(const Lens& lens) {
  const char* vignetting = lens.vignetting == Lens::Vignetting::cos4 ? "cos4" : lens.vignetting == Lens::Vignetting::off ? "off" : "table";
  Json json = Json::object();
  json.set("fx_px", lens.fx_px).set("fy_px", lens.fy_px).set("cx_px", lens.cx_px).set("cy_px", lens.cy_px);
  json.set("k1", lens.k1).set("k2", lens.k2).set("p1", lens.p1).set("p2", lens.p2).set("k3", lens.k3);
  json.set("f_number", lens.f_number).set("transmission", lens.transmission).set("vignetting", vignetting);
  if (lens.vignetting == Lens::Vignetting::table) json.set("vignetting_table", curve_json(lens.vignetting_table));
  return json;
}

Json filter_json(const Filter& filter) {
  Json json = Json::object();
  json.set("center_m", filter.center_m).set("half_width_m", filter.half_width_m).set("peak", filter.peak);
  if (!filter.table.x.empty()) json.set("table", curve_json(filter.table));
  return json;
}

Json pattern_json(const Pattern& pattern) {
  Json json = Json::object();
  switch (pattern.kind) {
    case Pattern::Kind::cone: return json.set("kind", "cone").set("half_angle_rad", pattern.half_angle_rad);
    case Pattern::Kind::lambertian: return json.set("kind", "lambertian");
    case Pattern::Kind::cosine_lobe: return json.set("kind", "cosine_lobe").set("exponent", pattern.exponent);
    case Pattern::Kind::flat_top:
      return json.set("kind", "flat_top").set("width_rad", pattern.width_rad).set("height_rad", pattern.height_rad);
    case Pattern::Kind::table: break;
  }
  json.set("kind", "table").set("columns", pattern.columns).set("rows", pattern.rows);
  json.set("half_range_x_rad", pattern.half_range_x_rad).set("half_range_y_rad", pattern.half_range_y_rad);
  return json.set("samples", Json::list(pattern.samples));
}

Json waveform_json(const Waveform& waveform) {
  const char* kind = waveform.kind == Waveform::Kind::rectangular ? "rectangular"
                     : waveform.kind == Waveform::Kind::sine      ? "sine"
                                                                  : "measured";
  Json json = Json::object();
  json.set("kind", kind).set("duty", waveform.duty).set("rise_time_s", waveform.rise_time_s).set("bandwidth_hz", waveform.bandwidth_hz);
  json.set("jitter_s", waveform.jitter_s).set("harmonics", waveform.harmonics);
  if (waveform.kind == Waveform::Kind::sine) json.set("modulation_depth", waveform.modulation_depth);
  if (waveform.kind == Waveform::Kind::measured) json.set("correlation", Json::list(waveform.correlation));
  return json;
}

Json illumination_json(const std::vector<Illumination>& lights) {
  Json list = Json::array();
  for (const Illumination& light : lights) {
    Json json = Json::object();
    json.set("position", Json::list(light.position)).set("axis", Json::list(light.axis));
    json.set("illumination_wavelength_m", light.illumination_wavelength_m).set("power_w", light.power_w);
    json.set("pattern", pattern_json(light.pattern)).set("waveform", waveform_json(light.waveform));
    list.push(std::move(json));
  }
  return list;
}

Json pixel_json(const Pixel& pixel) {
  Json json = Json::object();
  json.set("quantum_efficiency", curve_json(pixel.quantum_efficiency)).set("contrast", curve_json(pixel.contrast));
  json.set("bandwidth_hz", pixel.bandwidth_hz).set("full_well_e", pixel.full_well_e).set("read_noise_e", pixel.read_noise_e);
  json.set("dark_current_e_per_s", pixel.dark_current_e_per_s).set("prnu", pixel.prnu).set("dsnu_dn", pixel.dsnu_dn);
  json.set("delay_s", pixel.delay_s).set("pattern_seed", pixel.pattern_seed);
  json.set("suppression_threshold_e", pixel.suppression_threshold_e).set("suppression_budget_e", pixel.suppression_budget_e);
  return json.set("suppression_noise_factor", pixel.suppression_noise_factor);
}

Json adc_json(const Adc& adc) {
  Json json = Json::object();
  json.set("bits", adc.bits).set("step_e_per_dn", adc.step_e_per_dn).set("mid_code", adc.mid_code);
  return json.set("valid_min", adc.valid_min).set("valid_max", adc.valid_max);
}

Json decoding_json(const Decoding& decoding) {
  const ImageFilter& filter = decoding.filter;
  const char* kind = filter.kind == ImageFilter::Kind::none ? "none" : filter.kind == ImageFilter::Kind::gaussian ? "gaussian" : "median";
  Json json = Json::object();
  json.set("wiggling_correction", decoding.wiggling_correction).set("low_signal_noise_m", decoding.low_signal_noise_m);
  json.set("flying_near_z_m", decoding.flying_near_z_m).set("flying_near_limit_m", decoding.flying_near_limit_m);
  json.set("flying_far_z_m", decoding.flying_far_z_m).set("flying_far_limit_m", decoding.flying_far_limit_m);
  json.set("inconsistent_range_m", decoding.inconsistent_range_m);
  return json.set("filter", Json::object().set("kind", kind).set("sigma_px", filter.sigma_px).set("radius_px", filter.radius_px));
}

Json temperature_json(const Temperature& temperature) {
  Json json = Json::object();
  json.set("celsius", temperature.celsius).set("reference_celsius", temperature.reference_celsius);
  json.set("drift_m_per_kelvin", temperature.drift_m_per_kelvin).set("warm_up_m", temperature.warm_up_m);
  return json.set("warm_up_time_s", temperature.warm_up_time_s).set("since_start_s", temperature.since_start_s);
}

Json mode_json(const Mode& mode) {
  Json sequence = Json::array();
  for (const RawFrame& raw_frame : mode.sequence) {
    Json json = Json::object();
    json.set("lit", raw_frame.lit).set("modulation_frequency_hz", raw_frame.modulation_frequency_hz);
    json.set("reference_phase_rad", raw_frame.reference_phase_rad).set("integration_time_s", raw_frame.integration_time_s);
    sequence.push(std::move(json));
  }
  return Json::object().set("name", mode.name).set("frame_rate_hz", mode.frame_rate_hz).set("sequence", std::move(sequence));
}

Json camera_json(const Camera& camera) {
  const Sensor& sensor = camera.sensor;
  Json json = Json::object();
  json.set("name", camera.name);
  json.set("sensor", Json::object()
                         .set("width", sensor.width)
                         .set("height", sensor.height)
                         .set("pixel_pitch_m", sensor.pixel_pitch_m)
                         .set("fill_factor", sensor.fill_factor));
  json.set("lens", lens_json(camera.lens)).set("filter", filter_json(camera.filter));
  json.set("illumination", illumination_json(camera.illumination)).set("pixel", pixel_json(camera.pixel)).set("adc", adc_json(camera.adc));
  json.set("decoding", decoding_json(camera.decoding)).set("temperature", temperature_json(camera.temperature));
  json.set("refractive_index", camera.refractive_index).set("readout_time_s", camera.readout_time_s);
  json.set("min_integration_time_s", camera.min_integration_time_s);
  json.set("power_model", camera.power_model == PowerModel::tofray ? "tofray" : "paper_literal");
  return json.set("mode", mode_json(camera.mode));
}

// --- scene --------------------------------------------------------------------------------------------------------------------

Json ambient_json(const Ambient& ambient) {
  Json json = Json::object();
  switch (ambient.spectrum) {
    case Ambient::Spectrum::none: return json.set("spectrum", "none");
    case Ambient::Spectrum::sun_am15: json.set("spectrum", "sun_am15"); break;
    case Ambient::Spectrum::equal_energy: json.set("spectrum", "equal_energy"); break;
    case Ambient::Spectrum::table:
      json.set("spectrum", "table").set("table_wavelength_m", Json::list(ambient.table_wavelength_m));
      json.set("table_irradiance_w_per_m3", Json::list(ambient.table_irradiance_w_per_m3));
      break;
  }
  switch (ambient.quantity) {
    case Ambient::Quantity::level: json.set("level", ambient.amount); break;
    case Ambient::Quantity::illuminance_lx: json.set("illuminance_lx", ambient.amount); break;
    case Ambient::Quantity::band_irradiance_w_per_m2: json.set("band_irradiance_w_per_m2", ambient.amount); break;
  }
  if (ambient.direction) json.set("direction", Json::list(*ambient.direction));
  return json;
}

struct ShapeJson {
  Json& json;
  void operator()(const Plane& plane) const {
    json.set("shape", "plane").set("point", Json::list(plane.point)).set("normal", Json::list(plane.normal));
  }
  void operator()(const Sphere& sphere) const {
    json.set("shape", "sphere").set("center", Json::list(sphere.center)).set("radius", sphere.radius);
  }
  void operator()(const Box& box) const { json.set("shape", "box").set("min", Json::list(box.min)).set("max", Json::list(box.max)); }
  void operator()(const Triangle& triangle) const {
    Json vertices = Json::array();
    for (const Vec3& vertex : triangle.vertices) vertices.push(Json::list(vertex));
    json.set("shape", "triangle").set("vertices", std::move(vertices));
  }
};

Json object_json(const Object& object) {
  Json json = Json::object();
  json.set("name", object.name);
  std::visit(ShapeJson{json}, object.shape);
  json.set("material", object.material).set("position", Json::list(object.position));
  json.set("rotation", Json::object().set("axis", Json::list(object.rotation.axis)).set("angle_rad", object.rotation.angle_rad));
  return json.set("velocity_m_per_s", Json::list(object.velocity_m_per_s));
}

Json scene_json(const Scene& scene) {
  const Pose& pose = scene.camera.pose;
  Json materials = Json::array();
  for (const Material& material : scene.materials)
    materials.push(Json::object()
                       .set("name", material.name)
                       .set("brdf", material.brdf == Material::Brdf::lambert ? "lambert" : "phong")
                       .set("diffuse", material.diffuse)
                       .set("specular", material.specular)
                       .set("exponent", material.exponent));
  Json objects = Json::array();
  for (const Object& object : scene.objects) objects.push(object_json(object));
  Json json = Json::object();
  json.set("name", scene.name);
  json.set(
      "camera_pose",
      Json::object().set("position", Json::list(pose.position)).set("look_at", Json::list(pose.look_at)).set("up", Json::list(pose.up)));
  json.set("ambient", ambient_json(scene.ambient)).set("materials", std::move(materials));
  return json.set("objects", std::move(objects));
}

}  // namespace

const char* noise_name(Noise noise) { return noise == Noise::off ? "off" : noise == Noise::fast ? "fast" : "exact"; }

std::string frame_meta(const Scene& scene, const Camera& camera, std::uint64_t seed, Noise noise, std::uint64_t frame_index) {
  Json meta = Json::object();
  meta.set("tofray", version()).set("seed", seed).set("noise", noise_name(noise)).set("frame", frame_index);
  meta.set("units", units_json()).set("camera", camera_json(camera)).set("scene", scene_json(scene));
  return json_text(meta);
}

}  // namespace tofray::io
