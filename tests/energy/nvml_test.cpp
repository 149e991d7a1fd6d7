// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "energy/nvml.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

using namespace tofray::energy;

namespace {

/// A driver library whose answers a test sets.
struct Fake {
  int init = 0, find = 0, energy = 0;      // what the calls give
  unsigned long long millijoules[2] = {};  // of two GPUs
  int inits = 0, shutdowns = 0;
};
Fake fake;

const char* text_of(int error) { return error == 3 ? "Not Supported" : error == 999 ? nullptr : "Some Fault"; }

NvmlCalls fake_calls() {
  fake = {};
  NvmlCalls calls;
  calls.init = [] { return ++fake.inits, fake.init; };
  calls.shutdown = [] { return ++fake.shutdowns, 0; };
  calls.error_string = text_of;
  calls.device_by_index = [](unsigned index, void** device) { return *device = &fake.millijoules[index], fake.find; };
  calls.device_by_pci = [](const char* bus_id, void** device) {
    if (std::strcmp(bus_id, "0000:3b:00.0") != 0) return 6;
    return *device = &fake.millijoules[1], fake.find;
  };
  calls.device_name = [](void*, char* name, unsigned length) { return std::strncpy(name, "Some GPU", length), 0; };
  calls.total_energy = [](void* device, unsigned long long* millijoules) {
    *millijoules = *static_cast<unsigned long long*>(device);
    return fake.energy;
  };
  return calls;
}

}  // namespace

TEST(nvml, counts_joules_of_the_gpu_at_a_bus_id) {
  const NvmlCalls calls = fake_calls();
  fake.millijoules[0] = 1'000'000, fake.millijoules[1] = 70'000;
  {
    Nvml meter(calls, "0000:3b:00.0");
    ASSERT_TRUE(meter.readable()) << meter.reason();
    EXPECT_EQ(meter.what(), "Some GPU");
    fake.millijoules[1] = 80'000;
    meter.start();
    fake.millijoules[0] += 5'000'000;  // the other GPU
    fake.millijoules[1] += 1'250;
    EXPECT_DOUBLE_EQ(meter.joules(), 1.25);
    EXPECT_EQ(fake.shutdowns, 0);
  }
  EXPECT_EQ(fake.inits, 1);
  EXPECT_EQ(fake.shutdowns, 1);
}

TEST(nvml, without_a_bus_id_it_is_the_first_gpu) {
  const NvmlCalls calls = fake_calls();
  Nvml meter(calls, "");
  meter.start();
  fake.millijoules[0] = 500;
  EXPECT_DOUBLE_EQ(meter.joules(), 0.5);
}

TEST(nvml, says_which_call_failed_and_why) {
  const NvmlCalls calls = fake_calls();
  fake.init = 9;
  {
    Nvml meter(calls, "");
    EXPECT_EQ(meter.reason(), "NVML cannot start: Some Fault (error 9)");
    meter.start();
    EXPECT_TRUE(std::isnan(meter.joules()));
  }
  EXPECT_EQ(fake.shutdowns, 0);  // what did not begin is not ended
  fake.init = 0;
  EXPECT_EQ(Nvml(calls, "0000:99:00.0").reason(), "NVML cannot find the GPU: Some Fault (error 6)");
  fake.energy = 3;  // older than Volta, or a part of a GPU
  EXPECT_EQ(Nvml(calls, "").reason(), "NVML cannot read the GPU's energy: Not Supported (error 3)");
  fake.energy = 999;
  EXPECT_EQ(Nvml(calls, "").reason(), "NVML cannot read the GPU's energy: unknown (error 999)");
  EXPECT_EQ(fake.shutdowns, 3);
}

TEST(nvml, a_counter_that_fell_makes_the_result_unknown) {
  const NvmlCalls calls = fake_calls();
  fake.millijoules[0] = 1000;
  Nvml meter(calls, "");
  meter.start();
  fake.millijoules[0] = 10;
  EXPECT_TRUE(std::isnan(meter.joules()));
  EXPECT_NE(meter.reason().find("started anew"), std::string::npos);
}

TEST(nvml, a_library_that_is_missing_or_is_another_one_is_named) {
  std::string reason;
  load_nvml(reason, "libtofray-no-such-library.so.1");
  EXPECT_EQ(reason, "no NVIDIA driver library: libtofray-no-such-library.so.1: cannot open shared object file: No such file or directory");
  const NvmlCalls calls = load_nvml(reason, "libc.so.6");
  EXPECT_EQ(reason,
            "libc.so.6 is too old: it has no nvmlInit_v2, nvmlShutdown, nvmlErrorString, nvmlDeviceGetHandleByIndex_v2, "
            "nvmlDeviceGetHandleByPciBusId_v2, nvmlDeviceGetName, nvmlDeviceGetTotalEnergyConsumption");
  EXPECT_EQ(calls.init, nullptr);
}
