# SPDX-License-Identifier: Apache-2.0
# What `cmake --install` gives: the library in both forms, its header, the command if it was built,
# and what find_package(accel) and pkg-config need. The folder may be moved afterwards.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

install(TARGETS accel_static accel_shared EXPORT accelTargets
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
    LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
    INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(FILES include/accel/accel.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/accel)
if(TARGET accel_command)
    install(TARGETS accel_command RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()

set(cmake_folder ${CMAKE_INSTALL_LIBDIR}/cmake/accel)
install(EXPORT accelTargets NAMESPACE accel:: DESTINATION ${cmake_folder})
write_basic_package_version_file(accelConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES accelConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/accelConfigVersion.cmake
    DESTINATION ${cmake_folder})

# From where accel.pc lies to the prefix. Folders given as absolute paths stay where they are.
set(pc_folder ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
if(IS_ABSOLUTE ${pc_folder})
    set(pc_prefix ${CMAKE_INSTALL_PREFIX})
else()
    file(RELATIVE_PATH pc_prefix /prefix/${pc_folder} /prefix)
    string(REGEX REPLACE "^(.*)/$" "\${pcfiledir}/\\1" pc_prefix ${pc_prefix})
endif()
foreach(folder LIBDIR INCLUDEDIR)
    set(pc_${folder} ${CMAKE_INSTALL_${folder}})
    if(NOT IS_ABSOLUTE ${pc_${folder}})
        string(PREPEND pc_${folder} "\${prefix}/")
    endif()
endforeach()
configure_file(accel.pc.in accel.pc @ONLY)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/accel.pc DESTINATION ${pc_folder})
