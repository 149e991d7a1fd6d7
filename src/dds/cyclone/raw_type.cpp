// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "dds/cyclone/raw_type.h"

#include <cstdio>
#include <cstring>
#include <memory>

namespace tofray::dds {

namespace {

struct RawType : ddsi_sertype {};

struct RawData : ddsi_serdata {
  std::uint32_t size = 0;         ///< with the encapsulation, without the padding
  std::unique_ptr<char[]> bytes;  ///< padded
};

const RawData& raw(const ddsi_serdata* data) { return *static_cast<const RawData*>(data); }

// Of types.

void free_type(ddsi_sertype* type) {
  ddsi_sertype_fini(type);
  delete static_cast<RawType*>(type);
}
bool equal_types(const ddsi_sertype*, const ddsi_sertype*) { return true; }  // the names are equal, and there is nothing else
std::uint32_t hash_of_type(const ddsi_sertype*) { return 0; }
// Samples are what a reader of Cyclone DDS gives to its user. There is none.
void zero_samples(const ddsi_sertype*, void*, size_t) {}
void realloc_samples(void**, const ddsi_sertype*, void*, size_t, size_t) {}
void free_samples(const ddsi_sertype*, void**, size_t, dds_free_op_t) {}

ddsi_sertype_ops type_operations() {
  ddsi_sertype_ops out{};
  out.version = ddsi_sertype_v0;
  out.free = free_type;
  out.zero_samples = zero_samples, out.realloc_samples = realloc_samples, out.free_samples = free_samples;
  out.equal = equal_types, out.hash = hash_of_type;
  return out;
}

// Of data.

bool equal_keys(const ddsi_serdata*, const ddsi_serdata*) { return true; }  // no key: one instance
std::uint32_t size_of(const ddsi_serdata* data) { return raw(data).size; }
void free_data(ddsi_serdata* data) { delete static_cast<RawData*>(data); }
void copy_out(const ddsi_serdata* data, size_t from, size_t size, void* to) { std::memcpy(to, raw(data).bytes.get() + from, size); }
ddsi_serdata* lend(const ddsi_serdata* data, size_t from, size_t size, ddsrt_iovec_t* out) {
  out->iov_base = raw(data).bytes.get() + from;
  out->iov_len = size;
  return ddsi_serdata_ref(data);
}
void take_back(ddsi_serdata* data, const ddsrt_iovec_t*) { ddsi_serdata_unref(data); }
/// The instance alone, which has no data.
ddsi_serdata* key_of(const ddsi_serdata* data) {
  auto* const out = new RawData;
  ddsi_serdata_init(out, data->type, SDK_KEY);
  out->type = nullptr;
  out->hash = data->hash;
  return out;
}
size_t describe(const ddsi_sertype*, const ddsi_serdata* data, char* text, size_t size) {
  return static_cast<size_t>(std::snprintf(text, size, "%u bytes", raw(data).size));
}
void no_keyhash(const ddsi_serdata*, ddsi_keyhash* out, bool) { std::memset(out, 0, sizeof *out); }

ddsi_serdata* nothing_received(const ddsi_sertype*, ddsi_serdata_kind, const nn_rdata*, size_t) { return nullptr; }
ddsi_serdata* nothing_given(const ddsi_sertype*, ddsi_serdata_kind, ddsrt_msg_iovlen_t, const ddsrt_iovec_t*, size_t) { return nullptr; }
ddsi_serdata* nothing_by_key(const ddsi_sertype*, const ddsi_keyhash*) { return nullptr; }
ddsi_serdata* nothing_sampled(const ddsi_sertype*, ddsi_serdata_kind, const void*) { return nullptr; }
bool no_sample(const ddsi_serdata*, void*, void**, void*) { return false; }
bool no_key_sample(const ddsi_sertype*, const ddsi_serdata*, void*, void**, void*) { return false; }

ddsi_serdata_ops data_operations() {
  ddsi_serdata_ops out{};
  out.eqkey = equal_keys, out.get_size = size_of, out.free = free_data;
  out.to_ser = copy_out, out.to_ser_ref = lend, out.to_ser_unref = take_back;
  out.to_untyped = key_of, out.print = describe, out.get_keyhash = no_keyhash;
  out.from_ser = nothing_received, out.from_ser_iov = nothing_given, out.from_keyhash = nothing_by_key;
  out.from_sample = nothing_sampled, out.to_sample = no_sample, out.untyped_to_sample = no_key_sample;
  return out;
}

}  // namespace

ddsi_sertype* make_raw_type(const char* dds_type_name) {
  static const ddsi_sertype_ops type = type_operations();
  static const ddsi_serdata_ops data = data_operations();
  auto* const out = new RawType{};
  ddsi_sertype_init(out, dds_type_name, &type, &data, true);
  out->allowed_data_representation = DDS_DATA_REPRESENTATION_FLAG_XCDR1;
  return out;
}

ddsi_serdata* make_raw_data(const ddsi_sertype* type, std::string_view cdr) {
  auto* const out = new RawData;
  ddsi_serdata_init(out, type, SDK_DATA);
  out->hash = type->serdata_basehash;
  out->size = static_cast<std::uint32_t>(cdr.size());
  const std::size_t padded = (cdr.size() + 3) / 4 * 4;
  out->bytes = std::make_unique<char[]>(padded);
  std::memcpy(out->bytes.get(), cdr.data(), cdr.size());
  return out;
}

}  // namespace tofray::dds
