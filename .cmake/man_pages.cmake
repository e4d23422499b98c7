# Makes heel.1.gz, and heel-VERB.1.gz for each verb and each verb of a verb, in the folder PAGES, of
# what the command HEEL answers to --help.

cmake_path(GET HEEL PARENT_PATH folder)
set(ENV{PATH} "${folder}:$ENV{PATH}")  # so that pages say "heel", not where it was built
file(REMOVE_RECURSE "${PAGES}")
file(MAKE_DIRECTORY "${PAGES}")

# A page for the command CALL ("heel learn"), of which DOES is said in a line; then its verbs' pages.
function(make_page call does)
  string(REPLACE " " ";" command "${call}")
  string(REPLACE " " "-" name "${call}")
  execute_process(COMMAND ${command} --help OUTPUT_VARIABLE help COMMAND_ERROR_IS_FATAL ANY)
  set(others "")
  if(NOT call STREQUAL heel)
    string(REGEX REPLACE "-[a-z]+$" "" above "${name}")
    list(APPEND others "${above}(1)")
  endif()
  if(help MATCHES "\nSubcommands:\n(( [^\n]*\n)+)")
    string(REGEX MATCHALL "[^\n]+" lines "${CMAKE_MATCH_1}")
    foreach(line IN LISTS lines)
      if(line MATCHES "^  ([a-z]+) +(.+)$")
        list(APPEND others "${name}-${CMAKE_MATCH_1}(1)")
        make_page("${call} ${CMAKE_MATCH_1}" "${CMAKE_MATCH_2}")
      endif()
    endforeach()
  endif()

  execute_process(COMMAND "${HELP2MAN}" --no-info --section=1 "--name=${does}"
    "--version-string=${VERSION}" "${call}"
    OUTPUT_VARIABLE page COMMAND_ERROR_IS_FATAL ANY)
  # help2man takes the first word for the name, and fills paragraphs: examples are lines.
  string(TOUPPER "${name}" title)
  string(REPLACE ".TH HEEL " ".TH ${title} " page "${page}")
  string(REPLACE "\n${call} \\- " "\n${name} \\- " page "${page}")
  string(REGEX REPLACE "(\\.SS \"Examples?:\"\n)\\.IP\n(([^.\n][^\n]*\n)+)" "\\1.IP\n.nf\n\\2.fi\n"
    page "${page}")
  list(JOIN others ",\n" see_also)
  file(WRITE "${PAGES}/${name}.1" "${page}.SH \"SEE ALSO\"\n${see_also}\n")
  execute_process(COMMAND "${GZIP}" -9n "${PAGES}/${name}.1" COMMAND_ERROR_IS_FATAL ANY)
endfunction()

make_page(heel "a mobile robot follows one person")
