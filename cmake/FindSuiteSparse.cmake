# CHOLMOD and SuiteSparseQR; Debian's libsuitesparse-dev ships no CMake package.
find_path(SuiteSparse_INCLUDE_DIR cholmod.h PATH_SUFFIXES suitesparse)
find_library(SuiteSparse_CHOLMOD cholmod)
find_library(SuiteSparse_SPQR spqr)
mark_as_advanced(SuiteSparse_INCLUDE_DIR SuiteSparse_CHOLMOD SuiteSparse_SPQR)

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(SuiteSparse REQUIRED_VARS
  SuiteSparse_CHOLMOD SuiteSparse_SPQR SuiteSparse_INCLUDE_DIR)
