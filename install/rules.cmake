# SPDX-License-Identifier: MIT
# What `make install` and `make deb` put where; install/places.h finds it there, below whatever prefix. A room with a
# package of its own, as python/, installs with another COMPONENT and names it in the property PACKAGES.
#
#   bin/twinpuck             lib/twinpuck/    the compiler, objects behind every program, page, libraries of programs
#   include/twinpuck/        share/twinpuck/  firmware, hal_dspic, worlds, examples, editors
#   lib/libtwinpuck.so       share/doc/twinpuck/  share/man/man1/  share/bash-completion/completions/
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME twinpuck)
set(tools lib/twinpuck)
set(share share/twinpuck)

install(TARGETS twinpuck RUNTIME DESTINATION bin)
install(TARGETS twinpuck-cc RUNTIME DESTINATION ${tools})
install(TARGETS dspic_translate controller LIBRARY DESTINATION ${tools})
set_target_properties(twinpuck-cc dspic_translate PROPERTIES INSTALL_RPATH /usr/lib/llvm-14/lib)
if(TARGET JavaController)
  install(TARGETS JavaController LIBRARY DESTINATION ${tools})
  install(FILES ${CMAKE_BINARY_DIR}/Controller.jar DESTINATION ${tools})
endif()
install(DIRECTORY ${CMAKE_BINARY_DIR}/library DESTINATION ${tools} PATTERN made EXCLUDE PATTERN made.d EXCLUDE)
# without npm there is none, and view and --report say so
install(DIRECTORY ${CMAKE_BINARY_DIR}/page DESTINATION ${tools} OPTIONAL)

# for Python: where `twinpuck test` has it, and a link from where Python looks, with what pytest looks for
install(TARGETS python_core LIBRARY DESTINATION ${tools}/python/twinpuck)
install(DIRECTORY python/twinpuck DESTINATION ${tools}/python FILES_MATCHING PATTERN *.py PATTERN py.typed
        PATTERN __pycache__ EXCLUDE)
file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/dist-info/METADATA
     CONTENT "Metadata-Version: 2.1\nName: twinpuck\nVersion: @PROJECT_VERSION@\nSummary: firmware twin of the e-puck robot\n" @ONLY)
file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/dist-info/entry_points.txt
     CONTENT "[pytest11]\ntwinpuck.pytest_plugin = twinpuck.pytest_plugin\n")
install(CODE "
  if(CMAKE_INSTALL_PREFIX STREQUAL \"/usr\")
    set(packages lib/python3/dist-packages)
  else()
    set(packages lib/python${Python_VERSION_MAJOR}.${Python_VERSION_MINOR}/dist-packages)
  endif()
  set(whole \$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/\${packages})
  file(MAKE_DIRECTORY \${whole}/twinpuck-${PROJECT_VERSION}.dist-info)
  file(COPY ${CMAKE_BINARY_DIR}/dist-info/ DESTINATION \${whole}/twinpuck-${PROJECT_VERSION}.dist-info)
  file(RELATIVE_PATH module /\${packages} /${tools}/python/twinpuck)
  file(REMOVE \${whole}/twinpuck)
  file(CREATE_LINK \${module} \${whole}/twinpuck SYMBOLIC)
")

# for C++ programs: find_package(twinpuck)
install(TARGETS embed EXPORT twinpuck LIBRARY DESTINATION lib)
install(DIRECTORY embed/twinpuck DESTINATION include)
install(EXPORT twinpuck NAMESPACE twinpuck:: DESTINATION lib/cmake/twinpuck FILE twinpuckConfig.cmake)
include(CMakePackageConfigHelpers)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/twinpuckConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/twinpuckConfigVersion.cmake DESTINATION lib/cmake/twinpuck)

# sources that the compiler reads, and what people name or copy
foreach(folder firmware hal_dspic worlds editors examples tools/templates programs/supervisors programs/controller/include
               programs/controller/python)
  cmake_path(GET folder PARENT_PATH parent)
  install(DIRECTORY ${folder} DESTINATION ${share}/${parent}
          PATTERN __pycache__ EXCLUDE PATTERN node_modules EXCLUDE PATTERN build EXCLUDE
          REGEX "/firmware/.*/test\\.cpp$" EXCLUDE)
endforeach()
# what verbs read
install(FILES docs/lab.toml docs/lab-answers.md DESTINATION ${share}/docs OPTIONAL)  # the students' edition has no answers
install(FILES hal_sim/api/call_cycles.inc DESTINATION ${share}/hal_sim/api)
install(DIRECTORY docs/ DESTINATION share/doc/twinpuck FILES_MATCHING PATTERN *.md PATTERN *.png PATTERN *.gif)
install(FILES README.md DESTINATION share/doc/twinpuck)
install(FILES LICENSE DESTINATION share/doc/twinpuck RENAME copyright)

# what the command says of itself
install(DIRECTORY ${CMAKE_BINARY_DIR}/manual/man1 DESTINATION share/man)
install(DIRECTORY ${CMAKE_BINARY_DIR}/manual/bash-completion DESTINATION share)

# the Debian package
set_property(GLOBAL APPEND PROPERTY PACKAGES twinpuck)
get_property(packages GLOBAL PROPERTY PACKAGES)
set(CPACK_GENERATOR DEB)
set(CPACK_COMPONENTS_ALL ${packages})
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGE_CONTACT "Twinpuck <twinpuck@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "firmware twin of the e-puck robot")
set(CPACK_COMPONENT_TWINPUCK_DESCRIPTION
    "Runs the e-puck's own C programs on a PC, in virtual time, in a simulated world: compiler, debugger, live view, exact\ncycles, and images for the robot itself.")
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS OFF)
set(CPACK_DEBIAN_TWINPUCK_PACKAGE_NAME twinpuck)
set(CPACK_DEBIAN_TWINPUCK_PACKAGE_SECTION science)
# what is linked, dpkg-shlibdeps finds; these are loaded when they are needed (LAZY_LIBRARY), or started
set(CPACK_DEBIAN_TWINPUCK_PACKAGE_DEPENDS "binutils, libllvm14, libcairo2, libcivetweb1, libdw1, libjpeg62-turbo, libmuparser2v5, libsndfile1, libvpx7, python3 (>= 3.11), python3 (<< 3.12), python3-numpy, python3-pytest, python3-websocket")
# programs of the PC: compiled, or run by Python; `new` makes a Makefile
set(CPACK_DEBIAN_TWINPUCK_PACKAGE_RECOMMENDS "g++, make, python3-pytest-xdist, bubblewrap, bash-completion")
set(CPACK_DEBIAN_TWINPUCK_PACKAGE_SUGGESTS "default-jdk-headless, gdb, python3-pandas")
include(CPack)
