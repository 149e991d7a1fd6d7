# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
# The shared libraries that programs and libraries need, theirs included, one path a line:
#   cmake -D FILES=bin/tofray;lib/libtofray.so -D OWN=folder -D OUTPUT=file -P dependencies.cmake
# Left out is what every Linux has and what has to be the system's: the C library and what belongs to it, and the compiler's two libraries.
file(GET_RUNTIME_DEPENDENCIES LIBRARIES ${FILES} DIRECTORIES ${OWN}
  RESOLVED_DEPENDENCIES_VAR found UNRESOLVED_DEPENDENCIES_VAR missing CONFLICTING_DEPENDENCIES_PREFIX conflict
  PRE_EXCLUDE_REGEXES "^ld-linux" "^lib(c|m|dl|rt|pthread|gcc_s|stdc\\+\\+)\\.so")
if(missing OR conflict_FILENAMES)
  message(FATAL_ERROR "libraries that are not here: ${missing}; that are here twice: ${conflict_FILENAMES}")
endif()
list(JOIN found "\n" text)
file(WRITE ${OUTPUT} "${text}\n")
