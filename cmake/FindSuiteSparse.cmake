# SuiteSparseQR, which is loaded at run time; Debian's libsuitesparse-dev ships no CMake package.
find_path(SuiteSparse_INCLUDE_DIR cholmod.h PATH_SUFFIXES suitesparse)
find_library(SuiteSparse_SPQR spqr)
mark_as_advanced(SuiteSparse_INCLUDE_DIR SuiteSparse_SPQR)
if(SuiteSparse_SPQR)
  # libspqr.so is a link to libspqr.so.2.0.9, whose name among running programs is libspqr.so.2.
  get_filename_component(file ${SuiteSparse_SPQR} REALPATH)
  get_filename_component(file ${file} NAME)
  string(REGEX REPLACE "(\\.so\\.[0-9]+).*" "\\1" SuiteSparse_SPQR_SONAME ${file})
endif()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(SuiteSparse REQUIRED_VARS
  SuiteSparse_SPQR SuiteSparse_INCLUDE_DIR)
