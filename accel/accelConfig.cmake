# SPDX-License-Identifier: Apache-2.0
# find_package(accel): accel::static, accel::shared, and accel::accel, which is the shared one where
# BUILD_SHARED_LIBS is on.
include(${CMAKE_CURRENT_LIST_DIR}/accelTargets.cmake)
if(NOT TARGET accel::accel)
    add_library(accel::accel INTERFACE IMPORTED)
    if(BUILD_SHARED_LIBS)
        set_target_properties(accel::accel PROPERTIES INTERFACE_LINK_LIBRARIES accel::shared)
    else()
        set_target_properties(accel::accel PROPERTIES INTERFACE_LINK_LIBRARIES accel::static)
    endif()
endif()
