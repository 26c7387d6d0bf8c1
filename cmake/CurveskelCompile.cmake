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
  # instruction set (-march=native) each is compiled for: by plain malloc, as Eigen does without, and
  # the same layout of structs. <curveskel/surface.hpp> holds every user to it.
  target_compile_definitions(${target} PUBLIC
    EIGEN_MALLOC_ALREADY_ALIGNED=1 EIGEN_MAX_ALIGN_BYTES=16 EIGEN_MAX_STATIC_ALIGN_BYTES=16)
  # Memory is cheaper than the compiler's tidying: a tenth of the time of compiling is saved.
  # (clang-tidy, which reads the commands of Debug, takes no such parameter.)
  target_compile_options(${target} PRIVATE
    $<$<AND:$<CXX_COMPILER_ID:GNU>,$<NOT:$<CONFIG:Debug>>>:
      --param=ggc-min-expand=400 --param=ggc-min-heapsize=500000>)
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

# Units of many sources for a library, in place of CMake's own: headers cost most of the time of
# compiling, so sources that include the same heavy library share a unit, and the heaviest unit
# comes first, as the one that takes longest must not be the last. Call it where the target was
# made, when it has all its sources. Without CMAKE_UNITY_BUILD each source is compiled alone.
function(curveskel_units target)
  if(NOT CMAKE_UNITY_BUILD)
    return()
  endif()
  get_target_property(sources ${target} SOURCES)
  list(FILTER sources INCLUDE REGEX "\\.cpp$")
  set_target_properties(${target} PROPERTIES UNITY_BUILD OFF)
  set(units "")
  foreach(heavy IN ITEMS
      "corefinement=CGAL/.*/corefinement" "CGAL=CGAL/" "OpenMesh=OpenMesh/"
      "nlohmann=(nlohmann/|tiny_gltf)" "stb=stb/")
    string(REGEX MATCH "^[A-Za-z]+" name ${heavy})
    string(REGEX REPLACE "^[A-Za-z]+=" "" heavy ${heavy})
    set(group "")
    foreach(source IN LISTS sources)
      file(STRINGS ${source} includes REGEX "^#include <${heavy}" LIMIT_COUNT 1)
      if(includes)
        list(APPEND group ${source})
      endif()
    endforeach()
    if(group)
      list(REMOVE_ITEM sources ${group})
      curveskel_unit(${name} ${group})
    endif()
  endforeach()
  # GCC believes that CGAL's new cells may be null.
  set_source_files_properties(${PROJECT_BINARY_DIR}/units/CGAL.cpp PROPERTIES
    COMPILE_OPTIONS -Wno-null-dereference)
  # With sanitizers GCC believes that OpenMesh copies properties that were never set, and CGAL's
  # exact kernel triangles.
  set_source_files_properties(
    ${PROJECT_BINARY_DIR}/units/OpenMesh.cpp ${PROJECT_BINARY_DIR}/units/corefinement.cpp
    PROPERTIES COMPILE_OPTIONS "-Wno-null-dereference;-Wno-maybe-uninitialized")
  list(LENGTH sources count)
  math(EXPR units_of_the_rest "(${count} - 1) / ${CMAKE_UNITY_BUILD_BATCH_SIZE} + 1")
  math(EXPR batch "(${count} - 1) / ${units_of_the_rest} + 1")
  set(number 0)
  while(sources)
    list(SUBLIST sources 0 ${batch} group)
    list(REMOVE_ITEM sources ${group})
    curveskel_unit(${number} ${group})
    math(EXPR number "${number} + 1")
  endwhile()
  target_sources(${target} PRIVATE ${units})
endfunction()

# One unit, added to `units` of the caller.
function(curveskel_unit name)
  set(text "")
  foreach(source IN LISTS ARGN)
    string(APPEND text "#include \"${source}\"\n")
  endforeach()
  set(unit ${PROJECT_BINARY_DIR}/units/${name}.cpp)
  file(CONFIGURE OUTPUT ${unit} CONTENT "${text}" @ONLY)
  set_source_files_properties(${ARGN} PROPERTIES HEADER_FILE_ONLY ON)
  set(units ${units} ${unit} PARENT_SCOPE)
endfunction()

# An object library with files as string constants, declared by `header` (cmake/EmbedText.cmake). A
# library of its own, as a custom command serves only the targets of its own folder; and so that it
# can be made before anything else.
function(curveskel_embed library header)
  list(TRANSFORM ARGN PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/ OUTPUT_VARIABLE files)
  get_filename_component(name ${header} NAME_WE)
  set(embedded ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp)
  list(JOIN files "," files_joined)
  add_custom_command(OUTPUT ${embedded}
    COMMAND ${CMAKE_COMMAND} -DHEADER=${header} -DOUTPUT=${embedded} -DFILES=${files_joined}
            -P ${PROJECT_SOURCE_DIR}/cmake/EmbedText.cmake
    DEPENDS ${files} ${PROJECT_SOURCE_DIR}/cmake/EmbedText.cmake
    COMMENT "Embedding ${name}" VERBATIM)
  add_library(${library} OBJECT ${embedded})
  curveskel_compile_settings(${library})
  set_target_properties(${library} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  target_include_directories(${library} PRIVATE ${PROJECT_SOURCE_DIR} ${PROJECT_SOURCE_DIR}/include)
endfunction()

# The manual page NAME.1 of a program, made with it of its --help, and installed. SEE is another
# page; verbs that have that page are left out.
function(curveskel_manual target name title see component)
  set(page ${CMAKE_CURRENT_BINARY_DIR}/${name}.1)
  set(script ${PROJECT_SOURCE_DIR}/cmake/ManPage.cmake)
  add_custom_command(TARGET ${target} POST_BUILD
    COMMAND ${CMAKE_COMMAND} -DPROGRAM=$<TARGET_FILE:${target}> -DNAME=${name} -DTITLE=${title}
            -DVERSION=${PROJECT_VERSION} -DSEE=${see} -DOUTPUT=${page} -P ${script}
    VERBATIM)
  set_property(TARGET ${target} APPEND PROPERTY LINK_DEPENDS ${script})
  install(FILES ${page} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT ${component})
endfunction()
