// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// The bridge of examples/mujoco: MuJoCo's own rays say where things are.
#include <gtest/gtest.h>

#ifndef TOFRAY_WITH_MUJOCO

TEST(mujoco, is_here) { GTEST_SKIP() << "MuJoCo was not found when CMake configured (Debian: libmujoco-dev)"; }

#else

#include <array>
#include <cmath>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>

#include "mirror.h"

using namespace tofray;

namespace {

struct World {
  std::unique_ptr<mjModel, void (*)(mjModel*)> model{nullptr, mj_deleteModel};
  std::unique_ptr<mjData, void (*)(mjData*)> data{nullptr, mj_deleteData};
};

World pendulum() {
  char fault[1000] = "";
  World out;
  out.model.reset(mj_loadXML((std::string(TOFRAY_SOURCE_DIR) + "/examples/mujoco/pendulum.xml").c_str(), nullptr, fault, sizeof fault));
  if (out.model == nullptr) throw std::runtime_error(fault);
  out.data.reset(mj_makeData(out.model.get()));
  for (int i = 0; i < out.model->nv; ++i) out.data->qvel[i] = 1;  // rad/s and m/s: in a frame all of it moves by millimetres and more
  mj_forward(out.model.get(), out.data.get());
  return out;
}

void step_until(World& world, double time_s) {
  while (world.data->time < time_s - 1e-9) {
    world.model->opt.timestep = std::min(1e-4, time_s - world.data->time);
    mj_step(world.model.get(), world.data.get());
  }
  mj_forward(world.model.get(), world.data.get());
}

/// What MuJoCo's ray through a pixel meets.
struct Met {
  int geom = -1;
  double z = 0;
};
Met meet(const World& world, int camera, const float* ray) {
  const mjtNum* const m = world.data->cam_xmat + 9 * camera;
  const double x = static_cast<double>(ray[0]), y = static_cast<double>(ray[1]);
  mjtNum way[3];  // x to the right, y up, z backward are its columns
  for (int k = 0; k < 3; ++k) way[k] = x * m[3 * k] - y * m[3 * k + 1] - m[3 * k + 2];
  Met out;
  out.z = mj_ray(world.model.get(), world.data.get(), world.data->cam_xpos + 3 * camera, way, nullptr, 1, -1, &out.geom);
  return out;
}

/// Whether both see the same at a pixel and all around it.
struct Compared {
  int pixels = 0, same = 0;
  double worst_m = 0;
  std::set<std::string> names;
};

/// Leaves out what is drawn by flat pieces, and pixels beside a rim, where a ray of floats and one of doubles may meet different things.
Compared compare(const World& world, const Mirror& mirror, const Frame& frame, const std::vector<float>& rays, int camera) {
  const int width = frame.truth.width, height = frame.truth.height;
  std::vector<Met> met;
  for (std::size_t i = 0; i < rays.size() / 2; ++i) met.push_back(meet(world, camera, &rays[2 * i]));
  Compared out;
  for (int v = 1; v + 1 < height; ++v)
    for (int u = 1; u + 1 < width; ++u) {
      const int at = v * width + u;
      const Met& here = met[static_cast<std::size_t>(at)];
      if (here.geom < 0) continue;
      const int object = frame.truth.object_id[static_cast<std::size_t>(at)];
      const bool same = object >= 0 && mirror.geom_of(object) == here.geom;
      ++out.pixels, out.same += same;
      bool rim = !same;
      for (const int other : {at - 1, at + 1, at - width, at + width}) rim |= met[static_cast<std::size_t>(other)].geom != here.geom;
      if (rim || world.model->geom_type[here.geom] == mjGEOM_ELLIPSOID) continue;
      out.names.insert(mirror.scene().objects[static_cast<std::size_t>(object)].name);
      out.worst_m = std::max(out.worst_m, std::abs(static_cast<double>(frame.truth.z_m[static_cast<std::size_t>(at)]) - here.z));
    }
  return out;
}

}  // namespace

// 10 µm: floats of 2 m are off by 0.1 µm, of 10 m (the floor far away) and seen at 3° by some µm.
TEST(mujoco, sees_with_its_own_rays_what_tofray_sees_at_nine_times_of_one_frame) {
  World world = pendulum();
  Mirror mirror(world.model.get(), "eye");
  const Camera camera = load_camera("pico-flexx");
  const std::vector<double> times = exposure_times(camera, 0.1);
  ASSERT_EQ(times.size(), 9u);
  const int eye = mj_name2id(world.model.get(), mjOBJ_CAMERA, "eye");
  step_until(world, 0.1);
  mirror.look(world.data.get());
  std::vector<mjtNum> places;
  for (const double when : times) {
    step_until(world, when);
    mirror.look(world.data.get());
    places.insert(places.end(), world.data->qpos, world.data->qpos + world.model->nq);
  }
  FrameRequest request = mirror.request(0, 0.1);
  Simulator simulator(mirror.scene(), camera, {.noise = Noise::off, .arrays = {"gt_z_m", "gt_object_id"}});
  Frame frame;
  simulator.frame(request, frame);
  const double truth_at = frame.truth.time_s;
  const std::vector<float> rays = pixel_rays(camera);
  for (std::size_t k = 0; k < times.size(); ++k) {
    // Ground truth is that of the middle raw frame: the frame begins so that this one is now.
    request.start_time_s = 0.1 + times[k] - truth_at;
    simulator.frame(request, frame);
    ASSERT_NEAR(frame.truth.time_s, times[k], 1e-12);
    std::copy_n(places.begin() + static_cast<std::ptrdiff_t>(k) * world.model->nq, world.model->nq, world.data->qpos);
    mj_forward(world.model.get(), world.data.get());
    const Compared found = compare(world, mirror, frame, rays, eye);
    EXPECT_LT(found.worst_m, 1e-5) << "raw frame " << k;
    EXPECT_GT(found.same, 0.995 * found.pixels) << "raw frame " << k;
    for (const char* const name : {"floor", "wall", "bin", "shelf", "rod", "bob", "wedge", "finger"})
      EXPECT_TRUE(found.names.contains(name)) << name << " was not compared";
  }
}

TEST(mujoco, moves_what_its_joints_move_and_leaves_out_what_is_not_drawn) {
  World world = pendulum();
  Mirror mirror(world.model.get(), "eye", {{"wood", load_material("wood")}, {"egg", load_material("skin")}});
  std::set<std::string> moving, all;
  mirror.look(world.data.get());
  for (const PlacedObject& one : mirror.request(0, 0).objects) moving.insert(one.name);
  for (const Object& one : mirror.scene().objects) all.insert(one.name);
  EXPECT_EQ(moving, (std::set<std::string>{"rod", "bob", "wedge", "finger", "geom.10"}));
  EXPECT_EQ(all.count("unseen"), 0u);
  EXPECT_EQ(all.count("egg"), 1u);
  const auto diffuse = [&](const std::string& name) {
    for (const Object& one : mirror.scene().objects)
      if (one.name == name) return mirror.scene().materials[static_cast<std::size_t>(one.material)].diffuse;
    return -1.0;
  };
  EXPECT_EQ(diffuse("wall"), 0.634);           // by MuJoCo's material
  EXPECT_EQ(diffuse("egg"), 0.603);            // by the geom's name
  EXPECT_NEAR(diffuse("floor"), 0.214, 1e-3);  // ((0.5 + 0.055)/1.055)^2.4
  EXPECT_TRUE(mirror.request(1, 0).objects.empty()) << "what was seen is of one frame";
}

TEST(mujoco, wants_a_camera_that_is_there) {
  const World world = pendulum();
  EXPECT_THROW(Mirror(world.model.get(), "ear"), std::runtime_error);
}

#endif
