// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "gltf/buffers.h"
#include "gltf/item.h"
#include "gltf/model.h"

namespace tofray::gltf {

enum class Component { int8, uint8, int16, uint16, uint32, float32 };

/// How numbers may be written, as bits.
namespace written {
inline constexpr unsigned real = 1, whole_unsigned = 2, whole_signed = 4, normalized_unsigned = 8, normalized_signed = 16,
                          whole_of_4_bytes = 32;
}

/// What a property takes of accessors.
struct Wanted {
  const char* type;        ///< "VEC3"
  const char* other_type;  ///< also good, or nullptr
  unsigned as;             ///< of `written`
  const char* text;        ///< type and component type for messages: "VEC3 of floats"
};

/// What an accessor says of itself, checked against its views.
struct Accessor {
  struct Sparse {
    std::uint64_t count = 0;
    int indices_view = none, values_view = none;
    std::uint64_t indices_offset = 0, values_offset = 0;
    Component indices = Component::uint32;
  };
  Item item;
  std::string_view type{};
  Component component = Component::float32;
  std::size_t width = 1;   ///< numbers of an element
  std::size_t column = 1;  ///< numbers of a column, each of which begins at a multiple of 4 bytes in matrices
  bool normalized = false;
  std::uint64_t count = 0;
  int view = none;
  std::uint64_t offset = 0;
  std::optional<Sparse> sparse{};
};

/// The accessors of a file. Each one's numbers are taken out of the buffers once.
class Accessors {
 public:
  /// Checks them all: types, and that they lie within their views.
  Accessors(const Item& root, const Buffers& buffers);

  [[nodiscard]] std::size_t size() const { return accessors_.size(); }
  /// @throws Error where it is not what an accessor may be, or does not lie within its views
  [[nodiscard]] const Accessor& operator[](int i) const;

  /// Numbers as they are meant: those that are normalized lie in [0, 1] or [−1, 1].
  /// @param user  who asks, for messages
  /// @throws Error where the accessor is not as wanted; (limit) where all numbers would take too much memory
  Floats floats(int accessor, const Wanted& wanted, const Item& user);
  /// The floats of an accessor, each of which has to be finite.
  Floats finite_floats(int accessor, const Wanted& wanted, const Item& user);
  /// The floats of an accessor, of which those that are not finite become 0. @param count  raised by their number
  Floats mended_floats(int accessor, const Wanted& wanted, const Item& user, std::size_t& count);
  /// Whole numbers below `limit`. @param things  what they number: "vertices"
  Wholes wholes_below(int accessor, const Wanted& wanted, const Item& user, std::uint64_t limit, std::string_view things);
  /// The largest of them, 0 where there is none.
  [[nodiscard]] std::uint32_t largest(int accessor) const { return taken_[static_cast<std::size_t>(accessor)].largest; }

 private:
  struct Taken {
    Floats floats, mended;
    Wholes wholes;
    std::size_t not_finite = 0, first_not_finite = 0;
    std::uint32_t largest = 0;
  };
  void check(const Accessor& accessor, const Wanted& wanted, const Item& user) const;
  /// Counts the memory of its numbers, 4 bytes each, or refuses.
  void charge(const Accessor& accessor);
  template <class Out>
  std::vector<Out> decode(const Accessor& accessor) const;

  const Buffers& buffers_;
  /// Read when one is used first: what nobody uses may be anything.
  mutable std::vector<std::optional<Accessor>> accessors_;
  std::vector<Item> items_;
  std::vector<Taken> taken_;
  std::uint64_t bytes_ = 0;
};

}  // namespace tofray::gltf
