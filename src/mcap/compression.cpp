// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "mcap/compression.h"

#ifdef TOFRAY_HAS_ZSTD
#include <zstd.h>
#endif

#include <new>

#include "tofray/error.h"

namespace tofray::mcap {

#ifdef TOFRAY_HAS_ZSTD

bool has_zstd() { return true; }

struct Packer::State {
  std::unique_ptr<ZSTD_CCtx, std::size_t (*)(ZSTD_CCtx*)> context{ZSTD_createCCtx(), &ZSTD_freeCCtx};
};

Packer::Packer() : state_(std::make_unique<State>()) {
  if (!state_->context) throw std::bad_alloc();
}

void Packer::append(std::string_view bytes, std::string& to) {
  constexpr int level = 1;
  const std::size_t before = to.size();
  to.resize(before + ZSTD_compressBound(bytes.size()));
  const std::size_t size =
      ZSTD_compressCCtx(state_->context.get(), to.data() + before, to.size() - before, bytes.data(), bytes.size(), level);
  if (ZSTD_isError(size) != 0) throw std::bad_alloc();  // there is room enough: nothing else can fail
  to.resize(before + size);
}

bool unpack(std::string_view packed, std::size_t size, std::string& to) {
  const unsigned long long said = ZSTD_getFrameContentSize(packed.data(), packed.size());
  if (said == ZSTD_CONTENTSIZE_ERROR || (said != ZSTD_CONTENTSIZE_UNKNOWN && said > size)) return false;
  to.resize(size);
  const std::size_t got = ZSTD_decompress(to.data(), size, packed.data(), packed.size());
  return ZSTD_isError(got) == 0 && got == size;
}

#else

bool has_zstd() { return false; }
struct Packer::State {};
Packer::Packer() = default;
void Packer::append(std::string_view, std::string&) { throw Error(ErrorKind::bug, "error: this build has no zstd"); }
bool unpack(std::string_view, std::size_t, std::string&) { throw Error(ErrorKind::bug, "error: this build has no zstd"); }

#endif

Packer::~Packer() = default;

}  // namespace tofray::mcap
