// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

#include "model/tables.h"
#include "tofray/error.h"

/// The checks of scenes and cameras, whether they come from files or were built in code: every number that is used is finite and within
/// its range. Behind these checks no arithmetic meets NaN or infinity from outside.
namespace tofray::model {

/// A member, or an element of it.
struct Spot {
  const void* record;
  const Table* table;
  const Row* row = nullptr;                ///< none: the struct as a whole
  enum Part { whole, x, y } part = whole;  ///< of a curve
  long long index = -1;
};

/// Where a member lies.
const void* address(const Slot& slot);

/// Receiver of faults, which knows what the user calls a member: a place in a file, or a path in code.
class Complaints {
 public:
  virtual ~Complaints() = default;
  /// Whether nothing is known yet against a struct's members; else it is passed over, but not what is below it.
  [[nodiscard]] virtual bool is_sound(const void* /*record*/, const Table& /*table*/) const { return true; }
  /// @param what   the fault, complete in itself
  /// @param more   what was got, what is expected
  virtual void add(const Spot& spot, const std::string& what, const std::string& more, ErrorKind kind) = 0;
  /// The member is out of range or the like: the message begins with its name.
  virtual void add_named(const Spot& spot, const std::string& what, const std::string& more, ErrorKind kind) = 0;

  /// Of a member of a struct.
  template <class Record>
  void add(const Record& record, const void* member, const std::string& what, const std::string& more,
           ErrorKind kind = ErrorKind::bad_input, long long index = -1) {
    const Table& table = table_of<Record>();
    add(Spot{&record, &table, row_of(table, &record, member), Spot::whole, index}, what, more, kind);
  }

  /// The row of a member; none where the address is no member's.
  static const Row* row_of(const Table& table, const void* record, const void* member);
};

/// Adds what is wrong with a struct and all below it.
void check(const Table& table, const void* record, Complaints& complaints);

/// Checks a struct that was set in code, and all below it.
/// @param name   what the path of its members begins with; may be empty
/// @throws Error (bad_input; limit for counts) naming the member
void check_in_code(const Table& table, const void* record, const std::string& name);
template <class T>
void check_in_code(const T& record, const std::string& name = {}) {
  check_in_code(table_of<T>(), &record, name);
}

}  // namespace tofray::model
