// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

#include "energy/meter.h"

/// NVML is the library that NVIDIA's driver brings for watching its GPUs. It is looked for when a program runs: nothing of it is needed to
/// build, and a machine without it has no energy figures and nothing else amiss.
namespace tofray::energy {

/// The calls of NVML that are used, by its binary interface: each gives 0 or an error number. Tests put others in their place.
struct NvmlCalls {
  int (*init)() = nullptr;
  int (*shutdown)() = nullptr;
  const char* (*error_string)(int error) = nullptr;
  int (*device_by_index)(unsigned index, void** device) = nullptr;
  int (*device_by_pci)(const char* bus_id, void** device) = nullptr;
  int (*device_name)(void* device, char* name, unsigned length) = nullptr;
  int (*total_energy)(void* device, unsigned long long* millijoules) = nullptr;
};

/// Loads the library; it stays loaded.
/// @param reason  why it cannot be used: empty where it can
NvmlCalls load_nvml(std::string& reason, const char* library = "libnvidia-ml.so.1");

/// Energy of one GPU's whole board since the driver was loaded, in millijoules that go up every 20 to 100 ms. Volta or newer.
class Nvml : public Meter {
 public:
  /// @param pci_bus_id  "0000:3b:00.0": CUDA may number the GPUs in another order. Empty: NVML's device 0
  explicit Nvml(const std::string& pci_bus_id);
  Nvml(const NvmlCalls& calls, const std::string& pci_bus_id);
  ~Nvml() override;

 protected:
  double advance() override;

 private:
  void open(const std::string& pci_bus_id);
  /// Whether a call was good; otherwise the reason says what it was for.
  bool good(const char* what, int error);

  NvmlCalls calls_;
  bool begun_ = false;
  void* device_ = nullptr;
  std::uint64_t before_ = 0;  ///< [mJ]
};

}  // namespace tofray::energy
