// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Where MuJoCo's structs have their arrays, for mujoco.py beside it: built by cc when a test begins, against the MuJoCo that is here.
#include <mujoco/mujoco.h>
#include <mujoco/mjxmacro.h>
#include <stddef.h>
#include <string.h>

struct Found {
  const char* type;
  void* data;
  int rows, columns;
};

struct Found model_member(mjModel* m, const char* wanted) {
  struct Found none = {0, 0, 0, 0};
  MJMODEL_POINTERS_PREAMBLE(m)
#define X(name) \
  if (strcmp(wanted, #name) == 0) return (struct Found){"int", &m->name, 0, 0};
  MJMODEL_INTS
#undef X
#undef MJ_M
#define MJ_M(n) m->n
#define X(type, name, rows, columns) \
  if (strcmp(wanted, #name) == 0) return (struct Found){#type, m->name, m->rows, columns};
  MJMODEL_POINTERS
#undef X
  (void)nq, (void)nv, (void)na, (void)nu, (void)nmocap;
  return none;
}

struct Found data_member(const mjModel* m, mjData* d, const char* wanted) {
  struct Found none = {0, 0, 0, 0};
  MJDATA_POINTERS_PREAMBLE(m)
  if (strcmp(wanted, "time") == 0) return (struct Found){"mjtNum", &d->time, 0, 0};
#define X(type, name, rows, columns) \
  if (strcmp(wanted, #name) == 0) return (struct Found){#type, d->name, m->rows, columns};
  MJDATA_POINTERS
#undef X
  (void)nv, (void)njmax;
  return none;
}

mjtNum* timestep_of(mjModel* m) { return &m->opt.timestep; }

/// What rays from one point meet, by mj_ray.
void meet(const mjModel* m, const mjData* d, const mjtNum* from, const mjtNum* ways, int count, int* geoms, mjtNum* distances) {
  for (int i = 0; i < count; ++i) distances[i] = mj_ray(m, d, from, ways + 3 * i, 0, 1, -1, geoms + i);
}
