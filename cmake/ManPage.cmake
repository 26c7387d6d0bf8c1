# Writes a manual page of the text that a program's --help has; run with cmake -P.
#   PROGRAM  the program to ask
#   NAME     of the page
#   TITLE    what NAME is, in a few words
#   VERSION  of the program
#   SEE      another page; a verb VERB with a page NAME-VERB of its own is left out
#   OUTPUT   the file to write
cmake_policy(VERSION 3.25)

function(ask result)
  execute_process(COMMAND ${PROGRAM} ${ARGN} --help OUTPUT_VARIABLE text RESULT_VARIABLE status)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${PROGRAM} ${ARGN} --help ends with ${status}")
  endif()
  set(${result} "${text}" PARENT_SCOPE)
endfunction()

# Entries ("  NAME  meaning", or the meaning in lines below) become tagged paragraphs.
function(as_roff result text)
  set(mark "\\\\&")  # so that no line is taken for a request
  string(REPLACE "\\" "\\e" text "\n${text}\n")
  string(REPLACE "-" "\\-" text "${text}")
  string(REGEX REPLACE "\n          +([^\n]+)" "\n${mark}\\1" text "${text}")
  set(name "(([^ \n]| [^ \n])+)")
  string(REGEX REPLACE "\n  ${name}  +([^\n]+)" "\n.TP\n.B \\1\n${mark}\\3" text "${text}")
  string(REGEX REPLACE "\n  ${name}\n" "\n.TP\n.B \\1\n" text "${text}")
  string(REGEX REPLACE "\n([A-Z][a-zA-Z ]+):\n" "\n.SS \\1\n" text "${text}")
  string(REGEX REPLACE "\nUsage: ([^\n]+)" "\n.PP\n.B \\1" text "${text}")
  string(REGEX REPLACE "\n\n+" "\n.PP\n" text "${text}")
  string(REGEX REPLACE "\n.PP\n(.SS|$)" "\n\\1" text "${text}")
  set(${result} "${text}" PARENT_SCOPE)
endfunction()

ask(help)
as_roff(body "${help}")
string(TOUPPER ${NAME} upper)
string(REPLACE "-" "\\-" name "${NAME}")
set(page ".\\\" Made at build time of the program's --help.\n.TH ${upper} 1 \"\" \"curveskel ${VERSION}\"\n")
string(APPEND page ".SH NAME\n${name} \\- ${TITLE}\n.SH DESCRIPTION${body}")
if(help MATCHES "\nSubcommands:\n(.*)\n\n")
  string(REGEX MATCHALL "\n  [a-z]+  " verbs "\n${CMAKE_MATCH_1}")
  foreach(verb IN LISTS verbs)
    string(STRIP "${verb}" verb)
    if("${NAME}-${verb}" STREQUAL SEE)
      continue()
    endif()
    ask(help ${verb})
    as_roff(body "${help}")
    string(TOUPPER ${verb} upper)
    string(APPEND page ".SH ${upper}${body}")
  endforeach()
endif()
string(REPLACE "-" "\\-" see "${SEE}")
string(APPEND page ".SH SEE ALSO\n.BR ${see} (1)\n")
file(WRITE ${OUTPUT} "${page}")
