// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <dds/dds.h>
#include <dds/ddsi/ddsi_serdata.h>
#include <dds/ddsi/ddsi_sertype.h>

#include <string_view>

/// Messages that are CDR already, for Cyclone DDS: a type without a key of which it knows the name alone, and whose data it hands on as
/// they are. For writers: nothing is ever made of what comes from the network.
namespace tofray::dds {

/// @return owned by the topic that is made of it, or by ddsi_sertype_unref()
ddsi_sertype* make_raw_type(const char* dds_type_name);

/// @param type  of the topic's entity
/// @param cdr   copied, with zeros up to a multiple of 4, as the wire has it
ddsi_serdata* make_raw_data(const ddsi_sertype* type, std::string_view cdr);

}  // namespace tofray::dds
