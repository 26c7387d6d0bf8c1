# Writes a C++ file that defines each of FILES as a string constant; run with cmake -P.
#   HEADER  the header that declares them, as it is included
#   OUTPUT  the file to write
#   FILES   paths, separated by commas; dir/one_ring.cl defines curveskel::one_ring_source
set(content "// Made at build time; edit the files that it quotes.\n#include \"${HEADER}\"\n\nnamespace curveskel {\n\n")
string(REPLACE "," ";" FILES "${FILES}")
foreach(file IN LISTS FILES)
  get_filename_component(name ${file} NAME_WE)
  file(READ ${file} text)
  if(text MATCHES "\\)embedded\"")
    message(FATAL_ERROR "${file} holds the mark )embedded\" that ends its own quotation; take it out")
  endif()
  string(APPEND content "const std::string_view ${name}_source = R\"embedded(${text})embedded\";\n\n")
endforeach()
file(WRITE ${OUTPUT} "${content}}  // namespace curveskel\n")
