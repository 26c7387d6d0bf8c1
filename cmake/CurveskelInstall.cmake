# What a user of the library gets: public headers, the CMake package, the program and a .deb of all.
# Third-party headers never appear in these (std and Eigen only); tests/checks holds them to it.
set(CURVESKEL_PUBLIC_BASE
  include/curveskel/advanced/file_names.hpp
  include/curveskel/advanced/graph.hpp
  include/curveskel/advanced/indices.hpp
  include/curveskel/advanced/names.hpp
  include/curveskel/advanced/union_find.hpp
  include/curveskel/advanced/write_file.hpp
  include/curveskel/error.hpp
  include/curveskel/monitor.hpp
  include/curveskel/surface.hpp
  include/curveskel/threads.hpp
)
set(CURVESKEL_PUBLIC_SURFACE
  include/curveskel/advanced/closed_manifold.hpp
  include/curveskel/advanced/coarsen.hpp
  include/curveskel/advanced/inscribed_balls.hpp
  include/curveskel/advanced/measures.hpp
  include/curveskel/advanced/tree.hpp
  include/curveskel/clean.hpp
  include/curveskel/read.hpp
  include/curveskel/repair.hpp
  include/curveskel/topology.hpp
  include/curveskel/write_surface.hpp
)
set(CURVESKEL_PUBLIC_CONTRACTION
  include/curveskel/advanced/device.hpp
  include/curveskel/advanced/laplacian.hpp
  include/curveskel/advanced/least_squares.hpp
  include/curveskel/contract.hpp
  include/curveskel/contract_repaired.hpp
  include/curveskel/fair.hpp
  include/curveskel/fair_polygons.hpp
)
set(CURVESKEL_PUBLIC_SKELETON
  include/curveskel/advanced/embed.hpp
  include/curveskel/advanced/extraction_cache.hpp
  include/curveskel/advanced/step_clock.hpp
  include/curveskel/advanced/surface_partition.hpp
  include/curveskel/advanced/surgery.hpp
  include/curveskel/branch_measures.hpp
  include/curveskel/branch_profiles.hpp
  include/curveskel/branch_territories.hpp
  include/curveskel/certificate.hpp
  include/curveskel/curve_skeleton.hpp
  include/curveskel/edit.hpp
  include/curveskel/evaluate_repaired.hpp
  include/curveskel/extract.hpp
  include/curveskel/extract_repaired.hpp
  include/curveskel/findings.hpp
  include/curveskel/html_page.hpp
  include/curveskel/labelled_surface.hpp
  include/curveskel/levels.hpp
  include/curveskel/lives.hpp
  include/curveskel/match.hpp
  include/curveskel/preset.hpp
  include/curveskel/skeleton_files.hpp
  include/curveskel/tries.hpp
  include/curveskel/view.hpp
)
set(CURVESKEL_PUBLIC_RIG
  include/curveskel/advanced/joints.hpp
  include/curveskel/advanced/skin_weights.hpp
  include/curveskel/body_plan.hpp
  include/curveskel/check_weights.hpp
  include/curveskel/compare_rigs.hpp
  include/curveskel/make_rig.hpp
  include/curveskel/pose.hpp
  include/curveskel/read_materials.hpp
  include/curveskel/read_rig.hpp
  include/curveskel/rest_pose.hpp
  include/curveskel/rig.hpp
  include/curveskel/rig_character.hpp
  include/curveskel/rig_files.hpp
  include/curveskel/rig_parts.hpp
  include/curveskel/rig_polygons.hpp
  include/curveskel/role_names.hpp
)
set(CURVESKEL_PUBLIC_APP
  include/curveskel.hpp
)
set(CURVESKEL_PUBLIC_HEADERS
  ${CURVESKEL_PUBLIC_BASE}
  ${CURVESKEL_PUBLIC_SURFACE}
  ${CURVESKEL_PUBLIC_CONTRACTION}
  ${CURVESKEL_PUBLIC_SKELETON}
  ${CURVESKEL_PUBLIC_RIG}
  ${CURVESKEL_PUBLIC_APP}
)
target_sources(curveskel PUBLIC FILE_SET HEADERS
  BASE_DIRS ${PROJECT_SOURCE_DIR}/include FILES ${CURVESKEL_PUBLIC_HEADERS})

include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/curveskel)
configure_package_config_file(cmake/curveskelConfig.cmake.in curveskelConfig.cmake
  INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(curveskelConfigVersion.cmake COMPATIBILITY SameMinorVersion)

install(TARGETS curveskel EXPORT curveskelTargets
  FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT curveskelTargets NAMESPACE curveskel:: DESTINATION ${package_dir})
install(FILES
  ${PROJECT_BINARY_DIR}/curveskelConfig.cmake ${PROJECT_BINARY_DIR}/curveskelConfigVersion.cmake
  DESTINATION ${package_dir})
install(FILES README.md CHANGELOG.md LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY docs workflow DESTINATION ${CMAKE_INSTALL_DOCDIR})

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME curveskel)
set(CPACK_PACKAGE_CONTACT "The curveskel developers <curveskel@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY ${PROJECT_DESCRIPTION})
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR})
# Several packages: a server has no use for what the window needs, nor for Python.
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL curveskel)
if(CURVESKEL_BUILD_VIEWER)
  list(APPEND CPACK_COMPONENTS_ALL viewer)
endif()
if(CURVESKEL_BUILD_PYTHON)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEBIAN_CURVESKEL_PACKAGE_NAME curveskel)
# Loaded at run time, so that dpkg-shlibdeps does not see it.
set(CPACK_DEBIAN_CURVESKEL_PACKAGE_DEPENDS "libspqr2")
set(CPACK_DEBIAN_CURVESKEL_PACKAGE_RECOMMENDS "libopenblas0")
set(CPACK_DEBIAN_CURVESKEL_PACKAGE_SUGGESTS "curveskel-view, libeigen3-dev, pocl-opencl-icd")
set(CPACK_COMPONENT_VIEWER_DESCRIPTION "Curve skeletons: the window, and pictures by OpenGL")
set(CPACK_DEBIAN_VIEWER_PACKAGE_NAME curveskel-view)
set(CPACK_DEBIAN_VIEWER_PACKAGE_DEPENDS "curveskel (= ${PROJECT_VERSION}), libgl1-mesa-dri")
# Letters of names; each is used where it is there.
set(CPACK_DEBIAN_VIEWER_PACKAGE_RECOMMENDS "fonts-dejavu-core, fonts-noto-cjk, libfontconfig1")
set(CPACK_COMPONENT_PYTHON_DESCRIPTION "Curve skeletons: import curveskel in Python 3")
set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-curveskel)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
# The module is for one version of the interpreter.
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
  "curveskel (= ${PROJECT_VERSION}), python3 (>= 3.11), python3 (<< 3.12), python3-numpy")
set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS
  "python3-pandas, python3-networkx, python3-scipy, python3-tqdm")
include(CPack)
