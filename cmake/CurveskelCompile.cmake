# Settings that each of the project's own targets compiles with; nothing here is global.
find_program(CURVESKEL_CCACHE ccache)

function(curveskel_compile_settings target)
  target_compile_features(${target} PUBLIC cxx_std_20)
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF)
  target_compile_options(${target} PRIVATE
    -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Wold-style-cast -Wcast-qual
    -Woverloaded-virtual -Wnull-dereference -Wdouble-promotion -Wformat=2
    $<$<BOOL:${CURVESKEL_WARNINGS_AS_ERRORS}>:-Werror>)
  # GCC 12 warns of its own std::string operator+ (GCC bug 105651).
  target_compile_options(${target} PRIVATE
    $<$<AND:$<CXX_COMPILER_ID:GNU>,$<VERSION_LESS:$<CXX_COMPILER_VERSION>,13>>:-Wno-restrict>)
  # Matrices cross the border of the library, so both sides must allocate them alike whatever
  # instruction set (-march=native) each is compiled for: the same way of allocating from 32 up, and
  # the same layout of structs. surface/surface.hpp holds every user to it.
  target_compile_definitions(${target} PUBLIC
    EIGEN_MAX_ALIGN_BYTES=32 EIGEN_MAX_STATIC_ALIGN_BYTES=16)
  # Same bytes on every machine of the same kind: no contraction of a*b+c into one rounding.
  target_compile_options(${target} PRIVATE -ffp-contract=off)
  if(CURVESKEL_SANITIZE)
    # With AddressSanitizer GCC believes that what the standard library allocates may be null.
    target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-null-dereference>)
    target_compile_options(${target} PUBLIC -fsanitize=${CURVESKEL_SANITIZE} -fno-omit-frame-pointer)
    target_link_options(${target} PUBLIC -fsanitize=${CURVESKEL_SANITIZE})
  endif()
  if(CURVESKEL_CCACHE)
    set_target_properties(${target} PROPERTIES CXX_COMPILER_LAUNCHER ${CURVESKEL_CCACHE})
  endif()
endfunction()
