// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "energy/meter.h"

#include <limits>

namespace tofray::energy {

void Meter::start() {
  if (readable()) advance();
  sum_ = 0;
}

double Meter::joules() {
  if (readable()) sum_ += advance();
  return readable() ? sum_ : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace tofray::energy
