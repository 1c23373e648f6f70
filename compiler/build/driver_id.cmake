# SPDX-License-Identifier: MIT
# Writes OUT: a name for what the build driver's SOURCES are now, so that an image made by another driver is made anew.
foreach(source ${SOURCES})
  file(SHA256 ${source} one)
  string(APPEND all ${one})
endforeach()
string(SHA256 all "${all}")
file(WRITE ${OUT} "#define TWINPUCK_DRIVER_ID \"${all}\"\n")
