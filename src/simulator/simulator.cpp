// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "tofray/simulator.h"

#include "backend/cpu/cpu.h"
#include "backend/cuda/cuda.h"
#include "base/constants.h"
#include "camera/frozen_camera.h"
#include "scene/ambient.h"
#include "scene/frozen_scene.h"
#include "simulator/check.h"
#include "simulator/filter.h"
#include "simulator/frame_memory.h"
#include "tofray/error.h"

namespace tofray {

namespace {

std::vector<Vec3> positions(const Camera& camera) {
  std::vector<Vec3> out;
  for (const Illumination& light : camera.illumination) out.push_back(light.position);
  return out;
}

void set_ambient(const Scene& scene, const Camera& camera, const Vec3& toward_sun, camera::PowerView& power) {
  if (scene.ambient.spectrum == Ambient::Spectrum::none || scene.ambient.amount == 0) return;
  power.ambient_kind = scene.ambient.direction ? 2 : 1;
  for (std::size_t k = 0; k < 3; ++k) power.sun_direction[k] = static_cast<float>(toward_sun[k]);
  // E/π through the lens, as electrons: the kernel multiplies by reflectivity and vignetting.                    [theory: eq. 2.10]
  const double rate = scene::band_electron_rate_factor(scene.ambient, camera.filter, camera.pixel.quantum_efficiency);
  if (!(rate <= 1e30)) {
    throw Error(ErrorKind::bad_input, "error: the ambient light is beyond measure\n  mind its amount, and the table of its spectrum");
  }
  power.ambient_rate = static_cast<float>(rate * static_cast<double>(power.watts_per_radiance) / base::pi);
}

/// The camera, once both are seen to be good.
const Camera& checked(const Scene& scene, const Camera& camera) {
  simulator::check(scene);
  simulator::check(camera);
  return camera;
}

}  // namespace

struct Simulator::Impl {
  Camera camera;
  SimulatorOptions options;
  camera::FrozenCamera frozen_camera;
  scene::FrozenScene frozen_scene;
  backend::Cpu cpu;
  pipeline::Setup setup{};
  pipeline::Job job{};
  std::vector<float> filtered;
  std::string fallback_reason;

  Impl(const Scene& scene, const Camera& profile, const SimulatorOptions& wanted)
      : camera(checked(scene, profile)),
        options(wanted),
        frozen_camera(camera, static_cast<int>(wanted.noise), wanted.seed),
        frozen_scene(scene, positions(camera), static_cast<int>(camera.mode.sequence.size())),
        cpu(wanted.isa, wanted.threads, frozen_scene.moves() ? static_cast<int>(camera.mode.sequence.size()) : 0) {
    setup.lens = frozen_camera.lens();
    for (std::size_t l = 0; l < frozen_camera.lights().size(); ++l) setup.lights[l] = frozen_camera.lights()[l].view;
    setup.power = frozen_camera.power();
    set_ambient(scene, camera, frozen_scene.toward_sun(), setup.power);
    setup.decoder = frozen_camera.decoder();
    setup.truth_slot = static_cast<std::int32_t>(camera.mode.sequence.size() / 2);
    setup.last_stage = static_cast<std::int32_t>(options.last_stage);
    setup.culling = options.culling;
    simulator::set_filter(camera.decoding.filter, job);
    if (job.filter != 0) filtered.resize(static_cast<std::size_t>(camera.sensor.width) * static_cast<std::size_t>(camera.sensor.height));
    job.filtered = filtered.data();
    if (options.backend != Backend::cpu) fallback_reason = backend::why_no_cuda(options.device).reason;
    if (options.backend == Backend::cuda) backend::refuse_cuda(fallback_reason);
  }

  void frame(std::uint64_t index, Frame& into) {
    into.index = index;
    simulator::prepare(into, camera, options.truth);
    const double start = static_cast<double>(index) / camera.mode.frame_rate_hz;
    std::vector<double> middle;
    into.raw.start_time_s.clear();
    for (std::size_t k = 0; k < camera.mode.sequence.size(); ++k) {
      into.raw.start_time_s.push_back(start + frozen_camera.raw_frame_start_s()[k]);
      middle.push_back(into.raw.start_time_s[k] + 0.5 * camera.mode.sequence[k].integration_time_s);
    }
    into.truth.time_s = middle[middle.size() / 2];
    if (frozen_scene.moves()) frozen_scene.update(middle);
    setup.scene = frozen_scene.view();
    setup.sensor = frozen_camera.sensor(start);
    job.out = simulator::view_of(into);
    job.index_low = static_cast<std::uint32_t>(index), job.index_high = static_cast<std::uint32_t>(index >> 32);
    cpu.run(setup, job);
  }
};

Simulator::Simulator(const Scene& scene, const Camera& camera, const SimulatorOptions& options) : impl_(std::make_unique<Impl>(scene, camera, options)) {}
Simulator::~Simulator() = default;
Simulator::Simulator(Simulator&&) noexcept = default;
Simulator& Simulator::operator=(Simulator&&) noexcept = default;

Frame Simulator::frame(std::uint64_t index) {
  Frame out;
  impl_->frame(index, out);
  return out;
}

void Simulator::frame(std::uint64_t index, Frame& into) { impl_->frame(index, into); }
std::string Simulator::backend() const { return "cpu"; }
std::string Simulator::device() const { return isa(); }
std::string Simulator::fallback_reason() const { return impl_->fallback_reason; }
std::string Simulator::isa() const { return backend::isa_name(impl_->cpu.isa()); }
int Simulator::threads() const { return impl_->cpu.threads(); }

}  // namespace tofray
