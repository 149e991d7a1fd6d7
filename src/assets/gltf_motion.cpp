// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "assets/gltf_motion.h"

#include <cmath>
#include <mutex>
#include <utility>

#include "assets/gltf_load.h"
#include "base/text.h"
#include "gltf/parts.h"
#include "tofray/error.h"

namespace tofray::assets {

namespace {

/// A model whose animation goes on. Its pieces ask for the same times one after the other.
class Film {
 public:
  Film(gltf::Model model, int animation, double start_s, bool loop)
      : model_(std::move(model)), animation_(animation), start_s_(start_s), loop_(loop) {}

  /// Calls take(part) for all parts at a time.
  template <class Take>
  void each_part(double time_s, const Take& take) {
    const std::lock_guard lock(mutex_);
    if (!known_ || time_s != time_s_) {
      known_ = false;
      parts_ = gltf::parts(model_, pose_at(model_, animation_, in_animation(time_s)));
      time_s_ = time_s, known_ = true;
    }
    for (const gltf::Part& part : parts_) take(part);
  }

 private:
  [[nodiscard]] double in_animation(double time_s) const {
    const double time = start_s_ + time_s, end = model_.animations[static_cast<std::size_t>(animation_)].end_s;
    return loop_ && end > 0 ? time - end * std::floor(time / end) : time;
  }

  const gltf::Model model_;
  const int animation_;
  const double start_s_;
  const bool loop_;
  std::mutex mutex_;
  bool known_ = false;
  double time_s_ = 0;
  std::vector<gltf::Part> parts_;
};

/// One piece of it.
class PieceMotion : public MeshMotion {
 public:
  /// @param material  of whose triangles the piece is, if `apart`; else it is all of them
  PieceMotion(std::shared_ptr<Film> film, bool apart, int material, std::size_t not_finite)
      : film_(std::move(film)), apart_(apart), material_(material), not_finite_(not_finite) {}

  void at(double time_s, std::vector<std::array<float, 3>>& vertices, std::vector<std::array<float, 3>>& normals) const override {
    vertices.clear(), normals.clear();
    std::size_t not_finite = 0;
    film_->each_part(time_s, [&](const gltf::Part& part) {
      if (apart_ && part.material != material_) return;
      const std::size_t before = vertices.size();
      vertices.insert(vertices.end(), part.mesh.vertices.begin(), part.mesh.vertices.end());
      if (!part.normals.empty() || !normals.empty()) {
        normals.resize(before), normals.insert(normals.end(), part.normals.begin(), part.normals.end());
        normals.resize(vertices.size());
      }
      not_finite += part.not_finite;
    });
    if (not_finite > not_finite_)
      throw Error(ErrorKind::bad_input, "error: at " + base::number_text(time_s) +
                                            " s a corner of an animated glTF file is no finite number\n  it was one at the start");
  }

 private:
  std::shared_ptr<Film> film_;
  bool apart_;
  int material_;
  std::size_t not_finite_;
};

}  // namespace

void play(gltf::Model model, int animation, double start_s, bool loop, std::vector<MeshPiece>& pieces) {
  const auto film = std::make_shared<Film>(std::move(model), animation, start_s, loop);
  for (MeshPiece& piece : pieces) piece.motion = std::make_shared<PieceMotion>(film, piece.by_material, piece.number, piece.left_out);
}

}  // namespace tofray::assets
