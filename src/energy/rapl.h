// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <vector>

#include "energy/meter.h"

namespace tofray::energy {

/// The processor's energy: RAPL counters as Linux shows them, all packages (sockets) summed. AMD's are under the same name.
///
/// A package is cores, caches and memory controller; memory chips are not in it. Zones below a package are parts of it, and `psys` is the
/// whole board with the packages in it: neither is added. Counters go up in microjoules about every millisecond and start again at 0
/// beyond their largest value.
class Rapl : public Meter {
 public:
  /// @param root  where the zones are; another folder for tests
  explicit Rapl(const std::string& root = "/sys/class/powercap");

 protected:
  double advance() override;

 private:
  struct Zone {
    std::string file;           ///< …/intel-rapl:0/energy_uj
    std::uint64_t largest = 0;  ///< the counter's last value before 0 [µJ]
    std::uint64_t before = 0;   ///< what it last was [µJ]
  };
  bool read(const std::string& file, std::uint64_t& number);
  bool read_counter(const Zone& zone, std::uint64_t& number);
  std::vector<Zone> zones_;
};

/// How far a counter went that starts again at 0 beyond `largest`, at most once around.
std::uint64_t counted(std::uint64_t before, std::uint64_t now, std::uint64_t largest);

}  // namespace tofray::energy
