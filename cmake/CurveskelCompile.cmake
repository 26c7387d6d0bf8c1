# Settings that each of the project's own targets compiles with; nothing here is global.
find_program(CURVESKEL_CCACHE ccache)
if(CURVESKEL_TIDY)
  find_program(CURVESKEL_CLANG_TIDY NAMES clang-tidy-14 clang-tidy REQUIRED)
endif()

function(curveskel_compile_settings target)
  target_compile_features(${target} PUBLIC cxx_std_20)
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF)
  target_compile_options(${target} PRIVATE
    -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Wold-style-cast -Wcast-qual
    -Woverloaded-virtual -Wnull-dereference -Wdouble-promotion -Wformat=2
    $<$<BOOL:${CURVESKEL_WARNINGS_AS_ERRORS}>:-Werror>)
  # Same bytes on every machine of the same kind: no contraction of a*b+c into one rounding.
  target_compile_options(${target} PRIVATE -ffp-contract=off)
  if(CURVESKEL_SANITIZE)
    target_compile_options(${target} PUBLIC -fsanitize=${CURVESKEL_SANITIZE} -fno-omit-frame-pointer)
    # GCC 12's flow analysis misjudges instrumented code (a sort of at most 8 elements "reads the
    # 16th"): these stay warnings there, all others are errors.
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
      target_compile_options(${target} PRIVATE -Wno-error=array-bounds -Wno-error=null-dereference
        -Wno-error=restrict -Wno-error=stringop-overflow -Wno-error=maybe-uninitialized)
    endif()
    target_link_options(${target} PUBLIC -fsanitize=${CURVESKEL_SANITIZE})
  endif()
  if(CURVESKEL_CCACHE)
    set_target_properties(${target} PROPERTIES CXX_COMPILER_LAUNCHER ${CURVESKEL_CCACHE})
  endif()
  if(CURVESKEL_TIDY)
    set_target_properties(${target} PROPERTIES CXX_CLANG_TIDY ${CURVESKEL_CLANG_TIDY})
  endif()
endfunction()
