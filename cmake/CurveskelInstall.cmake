# What a user of the library gets: public headers, the CMake package, the program and a .deb of all.
# Third-party headers never appear in these (std and Eigen only); tests/checks holds them to it.
set(CURVESKEL_PUBLIC_HEADERS
  curveskel.hpp
  surface/clean.hpp
  surface/coarsen.hpp
  surface/error.hpp
  surface/inscribed_balls.hpp
  surface/measures.hpp
  surface/monitor.hpp
  surface/names.hpp
  surface/read.hpp
  surface/repair.hpp
  surface/surface.hpp
  surface/topology.hpp
  surface/tree.hpp
  surface/write_file.hpp
  surface/write_surface.hpp
  contraction/contract.hpp
  contraction/device.hpp
  contraction/fair.hpp
  contraction/laplacian.hpp
  contraction/least_squares.hpp
  skeleton/certificate.hpp
  skeleton/circles.hpp
  skeleton/curve_skeleton.hpp
  skeleton/edit.hpp
  skeleton/embed.hpp
  skeleton/evaluate_repaired.hpp
  skeleton/extract.hpp
  skeleton/extract_repaired.hpp
  skeleton/extraction_cache.hpp
  skeleton/findings.hpp
  skeleton/skeleton_files.hpp
  skeleton/surgery.hpp
  skeleton/view.hpp
  rig/joints.hpp
  rig/make_rig.hpp
  rig/read_rig.hpp
  rig/rig.hpp
  rig/rig_files.hpp
  rig/skin_weights.hpp
)
target_sources(curveskel PUBLIC FILE_SET HEADERS
  BASE_DIRS ${PROJECT_SOURCE_DIR} FILES ${CURVESKEL_PUBLIC_HEADERS})

include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/curveskel)
configure_package_config_file(cmake/curveskelConfig.cmake.in curveskelConfig.cmake
  INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(curveskelConfigVersion.cmake COMPATIBILITY SameMinorVersion)

install(TARGETS curveskel EXPORT curveskelTargets
  FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/curveskel)
install(EXPORT curveskelTargets NAMESPACE curveskel:: DESTINATION ${package_dir})
install(FILES
  ${PROJECT_BINARY_DIR}/curveskelConfig.cmake ${PROJECT_BINARY_DIR}/curveskelConfigVersion.cmake
  DESTINATION ${package_dir})
install(FILES README.md CHANGELOG.md LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR})

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
# Two packages: a server has no use for what the window needs.
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL curveskel viewer)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEBIAN_CURVESKEL_PACKAGE_NAME curveskel)
set(CPACK_DEBIAN_CURVESKEL_PACKAGE_RECOMMENDS "libopenblas0")
set(CPACK_DEBIAN_CURVESKEL_PACKAGE_SUGGESTS "curveskel-view, libeigen3-dev, pocl-opencl-icd")
set(CPACK_COMPONENT_VIEWER_DESCRIPTION "Curve skeletons: the window, and pictures by OpenGL")
set(CPACK_DEBIAN_VIEWER_PACKAGE_NAME curveskel-view)
set(CPACK_DEBIAN_VIEWER_PACKAGE_DEPENDS "curveskel (= ${PROJECT_VERSION}), libgl1-mesa-dri")
include(CPack)
