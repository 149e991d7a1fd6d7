// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "energy/nvml.h"

#include <dlfcn.h>
#include <fmt/core.h>

namespace tofray::energy {

namespace {

template <class Function>
void find(void* library, const char* symbol, Function& function, std::string& missing) {
  function = reinterpret_cast<Function>(::dlsym(library, symbol));
  if (function == nullptr) missing += (missing.empty() ? "" : ", ") + std::string(symbol);
}

}  // namespace

NvmlCalls load_nvml(std::string& reason, const char* library) {
  NvmlCalls calls;
  void* const handle = ::dlopen(library, RTLD_NOW | RTLD_LOCAL);
  if (handle == nullptr) {
    const char* const fault = ::dlerror();
    reason = fmt::format("no NVIDIA driver library: {}", fault == nullptr ? library : fault);
    return calls;
  }
  std::string missing;
  find(handle, "nvmlInit_v2", calls.init, missing);
  find(handle, "nvmlShutdown", calls.shutdown, missing);
  find(handle, "nvmlErrorString", calls.error_string, missing);
  find(handle, "nvmlDeviceGetHandleByIndex_v2", calls.device_by_index, missing);
  find(handle, "nvmlDeviceGetHandleByPciBusId_v2", calls.device_by_pci, missing);
  find(handle, "nvmlDeviceGetName", calls.device_name, missing);
  find(handle, "nvmlDeviceGetTotalEnergyConsumption", calls.total_energy, missing);
  reason = missing.empty() ? "" : fmt::format("{} is too old: it has no {}", library, missing);
  return calls;
}

Nvml::Nvml(const std::string& pci_bus_id) {
  std::string reason;
  calls_ = load_nvml(reason);
  if (reason.empty())
    open(pci_bus_id);
  else
    cannot(reason);
}

Nvml::Nvml(const NvmlCalls& calls, const std::string& pci_bus_id) : calls_(calls) { open(pci_bus_id); }

Nvml::~Nvml() {
  if (begun_) calls_.shutdown();
}

void Nvml::open(const std::string& pci_bus_id) {
  if (!good("start", calls_.init())) return;
  begun_ = true;
  const int found = pci_bus_id.empty() ? calls_.device_by_index(0, &device_) : calls_.device_by_pci(pci_bus_id.c_str(), &device_);
  if (!good("find the GPU", found)) return;
  char name[96] = "";
  if (calls_.device_name(device_, name, sizeof name) == 0) measures(name);
  Nvml::advance();
}

bool Nvml::good(const char* what, int error) {
  if (error == 0) return true;
  const char* const text = calls_.error_string(error);
  cannot(fmt::format("NVML cannot {}: {} (error {})", what, text == nullptr ? "unknown" : text, error));
  return false;
}

double Nvml::advance() {
  unsigned long long now = 0;
  if (!good("read the GPU's energy", calls_.total_energy(device_, &now))) return 0;
  if (now < before_) cannot("the GPU's energy counter started anew: its driver was loaded again");
  const double joules = readable() ? 1e-3 * static_cast<double>(now - before_) : 0;
  before_ = now;
  return joules;
}

}  // namespace tofray::energy
